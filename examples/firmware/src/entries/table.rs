//! Calls of the tables.

use core::hint::black_box;

use microimpact::table::{
    BoundarySlice, BoundarySliceMaker, BoundaryTable, BoundaryTableMaker, Lookup, RestitutionTable,
    RestitutionTableMaker, Single, TableRebound,
};
use microimpact::{Coulomb, CriticalSpeed, InputError, NormalMotion, Sphere};

use super::{any, keep, motions};

/// Calls everything, with one number type.
pub(super) fn call_all<T: Single>() -> Result<(), InputError> {
    keep(any::<T>().single());
    keep(T::from_single(any()));
    boundary::<1, T>()?;
    boundary::<31, T>()?;
    remade()?;
    boundary_steps::<12, T>()?;
    restitution_steps::<12, 7, 10, T>()?;
    restitution::<1, 3, 4, T>()?;
    restitution::<12, 7, 10, T>()
}

fn boundary<const N: usize, T: Single>() -> Result<(), InputError> {
    let cells = black_box([[1; 4]; N]);
    let parts = BoundaryTable::from_parts(any(), black_box(1), cells);
    let source = |_| Ok(black_box(CriticalSpeed::At(any::<T>())));
    let table = parts.or(BoundaryTable::<N>::new(any::<T>(), source))?;
    let (normal, oblique, planar) = motions(&Sphere::solid(any::<T>(), any())?)?;
    keep(table.classify(any::<T>(), &normal));
    keep(table.classify(any::<T>(), &oblique));
    keep(table.classify(any::<T>(), &planar));
    keep((table.critical_speed(any::<T>()), table.radii::<T>(), table.margin::<T>()));
    keep(table.parts());
    keep(table.as_slice().parts());
    slice(black_box(&mut [[1; 4]; N][..]), &normal)
}

fn slice<T: Single>(cells: &mut [[i32; 4]], motion: &NormalMotion<T>) -> Result<(), InputError> {
    let filled = BoundarySlice::fill(any::<T>(), cells, |_| Ok(black_box(CriticalSpeed::At(any::<T>()))))?;
    keep(filled.classify(any::<T>(), motion));
    let (smallest, margin, cells) = filled.parts();
    keep(BoundarySlice::from_parts(smallest, margin, cells));
    keep(BoundarySlice::cell(smallest, margin, cells, any::<T>())?.map(|cell| cell.classify(any::<T>(), motion)));
    Ok(())
}

fn restitution<const N: usize, const R: usize, const S: usize, T: Single>() -> Result<(), InputError> {
    let boundary = BoundaryTable::<N>::new(any::<T>(), |_| Ok(black_box(CriticalSpeed::At(any::<T>()))))?;
    let source = |_, _| Ok(TableRebound { restitution: any::<T>(), impulse: any() });
    let table = RestitutionTable::<T, N, R, S>::new(boundary, any(), source)?;
    keep((table.error(), table.impulse_error(), table.boundary(), table.parts()));
    let (normal, oblique, planar) = motions(&Sphere::solid(any::<T>(), any())?)?;
    let friction = Coulomb::new(any::<T>())?;
    for reading in [table.look_up(any(), &normal), table.look_up(any(), &oblique), table.look_up(any(), &planar)] {
        keep(reading);
        keep(table.impulse_error_of(&reading));
        if let Lookup::Rebound { rebound, .. } = reading {
            keep(rebound.separation(&friction, any(), &oblique));
            keep(rebound.separation(&friction, any(), &planar));
        }
    }
    Ok(())
}

fn boundary_steps<const N: usize, T: Single>() -> Result<(), InputError> {
    let source = |_| Ok(black_box(CriticalSpeed::At(any::<T>())));
    let mut maker = black_box(BoundaryTableMaker::<N>::new(any::<T>())?);
    keep(maker.step(black_box(1), source)?);
    keep(maker.calls());
    let (mut maker, mut cells) = (black_box(BoundarySliceMaker::new(any::<T>())?), [[0; 4]; N]);
    keep(maker.step(black_box(&mut cells[..]), black_box(1), source)?.map(|table| table.parts().0));
    keep(maker.calls());
    Ok(())
}

fn restitution_steps<const N: usize, const R: usize, const S: usize, T: Single>() -> Result<(), InputError> {
    let boundary = BoundaryTable::<N>::new(any::<T>(), |_| Ok(black_box(CriticalSpeed::At(any::<T>()))))?;
    let mut maker = black_box(RestitutionTableMaker::<T, N, R, S>::new(boundary, any())?);
    keep(maker.step(black_box(1), |_, _| Ok(TableRebound { restitution: any::<T>(), impulse: any() }))?);
    keep(maker.calls());
    Ok(())
}

/// A table from its numbers, which depends on the number type.
fn remade() -> Result<(), InputError> {
    let boundary = BoundaryTable::<1>::new(any::<f32>(), |_| Ok(black_box(CriticalSpeed::At(any::<f32>()))))?;
    let source = |_, _| Ok(TableRebound { restitution: any::<f32>(), impulse: any() });
    let table = RestitutionTable::<f32, 1, 3, 4>::new(boundary, any(), source)?;
    keep(RestitutionTable::<f32, 1, 3, 4>::from_parts(black_box(table.parts())));
    Ok(())
}
