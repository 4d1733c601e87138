//! Words of `.adm` files.

/// Joints here and in assemblies.
pub(super) const JOINTS: [(&str, &str); 15] = [
    ("REVOLUTE", "RevoluteJoint"),
    ("CYLINDRICAL", "CylindricalJoint"),
    ("TRANSLATIONAL", "TranslationalJoint"),
    ("FIXED", "FixedJoint"),
    ("SPHERICAL", "SphericalJoint"),
    ("UNIVERSAL", "UniversalJoint"),
    ("HOOKE", "UniversalJoint"),
    ("PLANAR", "PlanarJoint"),
    ("CONVEL", "ConstantVelocityJoint"),
    ("ATPOINT", "SphericalJoint"),
    ("INLINE", "PointInLineJoint"),
    ("INPLANE", "PointInPlaneJoint"),
    ("ORIENTATION", "NoRotationJoint"),
    ("PARALLEL_AXES", "ParallelAxesJoint"),
    ("PERPENDICULAR", "PerpendicularJoint"),
];
/// Statements that change neither motion nor forces.
pub(super) const LEFT: [&str; 12] = [
    "GRAPHICS",
    "REQUEST",
    "MREQUEST",
    "OUTPUT",
    "RESULTS",
    "VARIABLE",
    "INTEGRATOR",
    "PREFERENCES",
    "LIST",
    "DEBUG",
    "LSE_OUTPUT",
    "MATERIAL",
];
/// Units of length, m.
pub(super) const LENGTHS: [(&str, f64); 9] = [
    ("METER", 1.0),
    ("MM", 1e-3),
    ("MILLIMETER", 1e-3),
    ("CM", 1e-2),
    ("CENTIMETER", 1e-2),
    ("KILOMETER", 1e3),
    ("INCH", 0.0254),
    ("FOOT", 0.3048),
    ("MICRON", 1e-6),
];
/// Units of mass, kg.
pub(super) const MASSES: [(&str, f64); 7] = [
    ("KILOGRAM", 1.0),
    ("KG", 1.0),
    ("GRAM", 1e-3),
    ("TONNE", 1e3),
    ("POUND_MASS", 0.453_592_37),
    ("OUNCE_MASS", 0.028_349_523_125),
    ("SLUG", 14.593_902_937_206),
];
/// Units of force, N.
pub(super) const FORCES: [(&str, f64); 5] = [
    ("NEWTON", 1.0),
    ("KNEWTON", 1e3),
    ("KILOGRAM_FORCE", 9.806_65),
    ("POUND_FORCE", 4.448_221_615_260_5),
    ("DYNE", 1e-5),
];
