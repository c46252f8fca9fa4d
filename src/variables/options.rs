//! Closed sets of named alternatives: the type behind every enumeration parameter and status.
//!
//! An [`options!`](crate::options!) declaration is the only place where an alternative, its public name and its
//! description are written; enumerations in model descriptions, documentation and files derive from it.

/// One alternative of an enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Item {
    /// Public name, for instance `minimum_norm`.
    pub name: &'static str,
    /// One sentence for the user.
    pub description: &'static str,
}

/// A value out of a closed set of named alternatives, numbered from 1.
pub trait Choice {
    /// Name of the type in model descriptions, for instance `UamResolution`: some hosts keep the types of all units in
    /// one name space.
    fn type_name(&self) -> &'static str;
    /// What the type decides, one sentence.
    fn type_description(&self) -> &'static str;
    /// All alternatives in order; the first has number 1.
    fn items(&self) -> &'static [Item];
    /// Number of the present value, from 1.
    fn number(&self) -> i32;
    /// Takes the value with this number; `false`, and no change, if there is none.
    fn choose(&mut self, number: i32) -> bool;

    /// Public name of the present value.
    fn name(&self) -> &'static str {
        let index = usize::try_from(self.number() - 1).unwrap_or_default();
        self.items().get(index).map_or("", |item| item.name)
    }
}

/// Declares an enumeration with public names; descriptions are the doc comments.
#[macro_export]
macro_rules! options {
    (
        #[doc = $about:literal]
        pub enum $type:ident { $(#[doc = $description:literal] $variant:ident = $name:literal,)+ }
    ) => {
        #[doc = $about]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $type { $(#[doc = $description] $variant,)+ }

        impl $crate::variables::options::Choice for $type {
            fn type_name(&self) -> &'static str { concat!("Uam", stringify!($type)) }
            fn type_description(&self) -> &'static str { $about.trim_ascii() }
            fn items(&self) -> &'static [$crate::variables::options::Item] {
                const ITEMS: &[$crate::variables::options::Item] =
                    &[$($crate::variables::options::Item { name: $name, description: $description.trim_ascii() },)+];
                ITEMS
            }
            fn number(&self) -> i32 { *self as i32 + 1 }
            fn choose(&mut self, number: i32) -> bool {
                let found = [$($type::$variant,)+].into_iter().find(|option| option.number() == number);
                if let Some(option) = found { *self = option; }
                found.is_some()
            }
        }
    };
}
