//! The terms among which a scene chooses: their numbers are those of the protocol of instruments, but for the end of a JKR contact.

/// The model of a scene.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// The rigid-body model.
    RigidBody,
    /// The simulation of the contact.
    Contact,
}

/// Restitution of a rigid body.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestitutionLaw {
    /// The same R at every speed.
    Constant,
    /// R = k/(k + v).
    Speed,
    /// R = k^p/(k^p + v^p).
    Power,
    /// That of an elastic-plastic sphere (Thornton 1997).
    ElasticPlastic,
    /// That of a viscoelastic sphere.
    Viscoelastic,
}

/// Adhesion of a rigid body.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReboundAdhesion {
    /// None.
    None,
    /// A coefficient rho.
    Coefficient,
    /// A work, J.
    Work,
    /// rho = l^q/(l^q + v^q).
    Speed,
}

/// Damping of the materials of a contact.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// None.
    None,
    /// That of Hunt and Crossley.
    Hysteretic,
    /// That of a viscoelastic material.
    Viscoelastic,
    /// That which, without adhesion, leaves the same restitution at every speed.
    Constant,
}

/// Adhesion of a contact, and where contact ends.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adhesion {
    /// None; contact ends at zero indentation.
    None,
    /// None; contact ends where damping cancels the elastic force.
    WithoutTension,
    /// The ring force of Brach and Dunn.
    Ring,
    /// Derjaguin, Muller and Toporov.
    Dmt,
    /// Johnson, Kendall and Roberts; contact ends where it snaps off.
    JkrSnapOff,
    /// The same; contact ends at the pull-off force.
    JkrPullOff,
}
