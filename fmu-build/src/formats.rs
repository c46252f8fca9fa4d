//! Texts for machines and people.

pub mod html;
pub mod markdown;
pub mod xml;
