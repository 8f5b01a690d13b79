//! Every law with every damping and end of contact, against solutions to 20 digits.

use microimpact::contact::Adaptive;
use microimpact::{CriticalSpeed, Dual, Real};
use reference::laws;

#[test]
fn impacts() {
    let rows = laws::impacts();
    assert_eq!(rows.len(), 69);
    let mut faults = String::new();
    for row in rows {
        let (outcome, found) = row.solve(row.inputs(), &Adaptive::new(1e-12).unwrap()).unwrap();
        let (_, derivatives) =
            row.solve(Dual::variables(row.inputs()), &Adaptive::new(Dual::constant(1e-12)).unwrap()).unwrap();
        let name = format!("{} {}", row.text("family"), row.text("name"));
        if outcome != Some(row.outcome()) {
            faults += &format!("{name}: {outcome:?}\n");
            continue;
        }
        for (index, exact) in row.solution().into_iter().enumerate() {
            let Some(exact) = exact else { continue };
            let allowed = if index == 0 { 1e-12 } else { 1e-9 * exact };
            let change = derivatives[index].map_or(0.0, |output| {
                let parts = output.partials.iter().zip(row.inputs());
                parts.map(|(partial, input)| (partial * input).abs()).sum::<f64>() * f64::EPSILON
            });
            let error = found[index].map_or(f64::INFINITY, |found| (found - exact).abs());
            if error > allowed.max(4.0 * change) {
                let column = ["e^2", "peak indentation", "its time", "contact time"][index];
                faults += &format!("{name} {column}: {:e} of {:e}\n", error / exact, allowed.max(4.0 * change) / exact);
            }
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

#[test]
fn critical_speeds() {
    let rows = laws::critical();
    assert_eq!(rows.len(), 10);
    for row in rows {
        let found = row.scene(row.inputs()).unwrap().critical_speed(&Adaptive::new(1e-10).unwrap()).unwrap();
        let exact = row.number("critical_speed_m_s").unwrap();
        let CriticalSpeed::At(found) = found else { panic!("{}: {found:?}", row.text("name")) };
        assert!((found / exact - 1.0).abs() < 1e-9, "{}: {found:e} {exact:e}", row.text("name"));
    }
}
