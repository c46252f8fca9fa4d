//! Which parameters decide the values of outputs at the end of initialization, in groups; see
//! [`crate::variables::Variable::initially_from`].

/// Where the links are.
pub const GEOMETRY: &[&str] = &["mount", "link.length", "joint.start"];

/// The angles of the joints.
pub const ANGLES: &[&str] = &["joint.start"];

/// Moments of the links' weight about the joints, per gravity.
pub const LINKS: &[&str] = &["link.mass", "link.length", "link.com", "joint.start"];

/// Where what balances the arm is.
pub const BALANCE: &[&str] = &["counterweight.start", "balance_element.start"];

/// The moment of its weight, per gravity.
pub const BALANCE_WEIGHT: &[&str] = &["counterweight.mass", "balance_element.mass", "balance_element.com"];

/// The first plan.
pub const PLAN: &[&str] = &[
    "gravity",
    "uav",
    "mount",
    "link",
    "joint",
    "counterweight",
    "balance_element",
    "autopilot",
    "payload",
    "support",
    "sample_time",
    "ik",
    "reference",
];
