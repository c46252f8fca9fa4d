//! FMUs and SSPs as files.
//!
//! [`interface`] takes a unit's table of variables as plain data; [`description`], [`documentation`] and [`ssp`] write what hosts
//! and people read of it; [`contents`] is all that an FMU holds, [`build`](mod@build) puts it together for a [`design`].

pub mod archive;
pub mod build;
pub mod contents;
pub mod description;
pub mod design;
pub mod documentation;
pub mod interface;
pub mod metadata;
pub mod ssp;
mod terminals;
pub mod text;
pub mod units;
