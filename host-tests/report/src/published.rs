//! Single impacts that others measured or solved, with ours: with and without compliance along the surface.

use std::error::Error;

use microimpact::Sphere;
use microimpact::contact::Unloading;
use reference::published::{Along, MODELS, OXIDE, SPHERE, Scene, impact, rms, scene, values};

use crate::content::{Cell, Part, Run, Section, Table};
use crate::paper::{column, figure};
use crate::plot::{self, Axis, Line, Mark};

const ANGLE: &str = "angle of incidence from the normal, degrees";
const MEASURED: &str = "Kharaz et al 2001";
const RESCALED: Along = Along::Compliant(Unloading::Rescaled);
const COMPUTED: &str = "Chung and Ooi 2011 test 4";

/// The speed of the balls, m/s.
const SPEED: f64 = 3.9;

/// A quantity of a ball.
struct Quantity {
    /// Name in the published values.
    published: &'static str,
    title: &'static str,
    /// Name, symbol and unit on its axis.
    axis: [&'static str; 3],
    /// Place in what [`at_angle`] gives.
    place: usize,
    /// Of the computed values.
    sign: f64,
}

const QUANTITIES: [Quantity; 3] = [
    Quantity {
        published: "tangential restitution",
        title: "Velocity of the centre along the surface",
        axis: ["tangential restitution", "V_t/v_t", "1"],
        place: 0,
        sign: 1.0,
    },
    Quantity {
        published: "spin rad/s",
        title: "Spin after the impact",
        axis: ["spin after", "Ω", "rad/s"],
        place: 1,
        sign: -1.0,
    },
    Quantity {
        published: "rebound angle of the contact point deg",
        title: "Direction in which the contact point rebounds",
        axis: ["angle from the normal", "φ", "°"],
        place: 2,
        sign: 1.0,
    },
];

/// Ranges of the angle over which we say how far apart values are: sticking, and sliding.
const RANGES: [(f64, f64); 3] = [(0.0, 9.0), (9.0, 32.5), (32.5, 90.0)];

pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let parts = || -> Result<Vec<Part>, Box<dyn Error>> {
        let _progress = run.progress(1, "published impacts");
        let ball = scene(Sphere::solid(2.5e-3, OXIDE.density)?, &OXIDE, (0.98, SPEED), 0.092)?;
        let [along, spin, angle] = QUANTITIES.each_ref().map(|quantity| balls(&ball, quantity));
        let about = Part::Text(
            "A contact that gives sideways sticks elastically before it slips (Mindlin 1949). Its stiffness along the surface \
             follows from the materials. The default rule rescales the force where the contact shrinks, so that no energy is made; \
             the incremental rule is that of other codes. Balls of alumina: 5 mm, 3.9 m/s, restitution 0.98, friction 0.092. Values \
             read from printed figures are exact to about one percent of the axis."
                .to_owned(),
        );
        Ok(vec![
            along?,
            angle?,
            Part::Fold(
                "Spin of the balls, and how far measured values are from ours".to_owned(),
                vec![spin?, differences(&ball)?],
            ),
            Part::Fold("Spheres of Thornton, Cummins and Cleary".to_owned(), vec![spheres()?]),
            Part::Fold("The models and the balls".to_owned(), vec![about]),
        ])
    };
    let section =
        |parts| Section { title: "Impacts that others measured", name: "published", parts, ..Section::default() };
    parts().map(section).map_err(|error| error.to_string())
}

/// Tangential restitution, spin, and rebound angle of the contact point of a ball at an angle from the normal.
fn at_angle(scene: &Scene, degrees: f64, along: Along) -> Result<[f64; 3], Box<dyn Error>> {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let after = impact(scene, [SPEED * cosine, SPEED * sine, 0.0], along)?;
    Ok([after.tangential / (SPEED * sine), after.peripheral / scene.contact.sphere().radius(), after.contact_angle()])
}

fn balls(ball: &Scene, quantity: &Quantity) -> Result<Part, Box<dyn Error>> {
    let &Quantity { published, title, axis: [axis, symbol, unit], place, sign } = quantity;
    let row = |angle: f64| {
        let of = |(_, along): (&str, Along)| Ok::<_, Box<dyn Error>>(at_angle(ball, angle, along)?[place]);
        let [rescaled, incremental, rigid] = MODELS;
        Ok([angle, of(rescaled)?, of(incremental)?, of(rigid)?])
    };
    let rows = (2..=88).map(|angle| row(f64::from(angle))).collect::<Result<Vec<_>, Box<dyn Error>>>()?;
    let computed =
        values(COMPUTED, "al oxide", published).into_iter().map(|(angle, value)| (angle, sign * value)).collect();
    let lines = [
        Line::new("measured", Mark::Points, values(MEASURED, "al oxide", published)).like(3),
        Line::new("Chung and Ooi", Mark::Points, computed).like(4),
        Line::new(MODELS[0].0, Mark::Solid, column(&rows, 1)).like(0),
        Line::new(MODELS[1].0, Mark::Dashed, column(&rows, 2)).like(1),
        Line::new(MODELS[2].0, Mark::Solid, column(&rows, 3)).like(2),
    ];
    let x = Axis::linear("angle of incidence from the normal", "α", "°").between(0.0, 90.0);
    let name = format!("published-{}", published.split(' ').next().unwrap_or_default());
    Ok(figure(
        title,
        plot::chart(&x, &Axis::linear(axis, symbol, unit), &lines)?,
        &name,
        "Measured by Kharaz, Gorham and Salman (2001), computed by Chung and Ooi (2011), and ours by three models of the contact \
         along the surface.",
        [ANGLE, MODELS[0].0, MODELS[1].0, MODELS[2].0],
        rows,
    ))
}

/// How far measured values are from ours.
fn differences(ball: &Scene) -> Result<Part, Box<dyn Error>> {
    let mut rows = Vec::new();
    for Quantity { published, title, axis: [_, symbol, unit], place, .. } in QUANTITIES {
        for (from, to) in RANGES {
            let inside = || {
                values(MEASURED, "al oxide", published).into_iter().filter(|(angle, _)| *angle >= from && *angle < to)
            };
            let mut cells = vec![
                Cell::Text(format!("{title} {symbol} [{unit}]")),
                Cell::Text(format!("{from} to {to}")),
                Cell::Count(inside().count() as u64),
            ];
            for (_, along) in MODELS {
                let errors = inside().map(|(angle, value)| Ok(at_angle(ball, angle, along)?[place] - value));
                let errors = errors.collect::<Result<Vec<_>, Box<dyn Error>>>()?;
                cells.push(Cell::Number((!errors.is_empty()).then(|| rms(errors.into_iter()))));
            }
            rows.push(cells);
        }
    }
    let columns = ["quantity", ANGLE, "values", MODELS[0].0, MODELS[1].0, MODELS[2].0];
    Ok(Part::Table(Table {
        name: "published-differences".to_owned(),
        caption: "Root mean square of the difference between measured values and ours. Below nine degrees none of the models fits; from \
                  32.5 degrees on the ball slides, and they are one."
            .to_owned(),
        columns: columns.map(str::to_owned).into(),
        rows,
    }))
}

fn spheres() -> Result<Part, Box<dyn Error>> {
    const BEFORE: &str = "slip before, 2 v_ct/(f (1 + e) v_n)";
    let mut lines = Vec::new();
    let mut curves = Vec::new();
    for (place, (series, restitution)) in [("e .90", 0.9), ("e .75", 0.75), ("e .50", 0.5)].into_iter().enumerate() {
        let scene = scene(Sphere::solid(0.025, SPHERE.density)?, &SPHERE, (restitution, 5.0), 0.1)?;
        let unit = 0.05 * (1.0 + restitution) * 5.0;
        let slip = |x: f64| Ok::<_, Box<dyn Error>>(impact(&scene, [5.0, unit * x, 0.0], RESCALED)?.slip() / unit);
        let curve = (1..=100).map(|step| 0.1 * f64::from(step)).map(|x| Ok((x, slip(x)?)));
        let curve = curve.collect::<Result<Vec<_>, Box<dyn Error>>>()?;
        lines.push(Line::new(&format!("ours, {series}"), Mark::Solid, curve.clone()).like(place));
        let inside =
            values("Thornton et al 2013", series, "slip after").into_iter().filter(|(x, _)| *x <= 10.0).collect();
        lines.push(Line::new(&format!("Thornton et al., {series}"), Mark::Points, inside).like(place));
        curves.push(curve);
    }
    let rows = (0..100).map(|row| [curves[0][row].0, curves[0][row].1, curves[1][row].1, curves[2][row].1]);
    Ok(figure(
        "Velocity v_ct of the contact point",
        plot::chart(
            &Axis::linear("slip before", "2 v_ct/(f (1 + e) v_n)", "1"),
            &Axis::linear("slip after", "2 V_ct/(f (1 + e) v_n)", "1"),
            &lines,
        )?,
        "published-slip",
        "Spheres of 25 mm radius, friction f 0.1, v_n 5 m/s, restitution e (Thornton, Cummins and Cleary 2013). Their damping is not the hysteretic one, which \
         counts more where e is less. A sphere that slides throughout has seven less after than before.",
        [BEFORE, "ours, e .90", "ours, e .75", "ours, e .50"],
        rows,
    ))
}
