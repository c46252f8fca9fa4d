//! How the variables of a unit are called.

/// A way of naming; some hosts make buses of structured names, which not everybody wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Naming {
    /// `joint[2].rate_command`
    Structured,
    /// `joint_2_rate_command`
    Flat,
}

impl Naming {
    /// All, the usual one first.
    pub const ALL: [Self; 2] = [Self::Structured, Self::Flat];

    /// Name in the standard and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Structured => "structured",
            Self::Flat => "flat",
        }
    }

    /// A variable's name, from its structured one.
    #[must_use]
    pub fn of(self, structured: &str) -> String {
        match self {
            Self::Structured => structured.to_owned(),
            Self::Flat => structured.replace(']', "").replace(['[', '.'], "_"),
        }
    }
}
