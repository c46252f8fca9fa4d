//! Messages to the host, through the callback that it hands over at instantiation.

use std::borrow::Cow;
use std::ffi::CString;
use std::fmt::Display;
use std::ptr;

use super::c_types::{CallbackFunctions, ComponentEnvironment, LoggerCallback, Status};
use crate::fmi::environment::Host;

/// What a message is about. The names are the standard's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// Initialization, end and reset of a simulation.
    Events,
    /// Something odd that does no harm.
    StatusWarning,
    /// A call that failed, and why.
    StatusError,
}

/// Every category with a description, as model descriptions declare them; `logAll` stands for all.
pub const CATEGORIES: [(&str, &str); 4] = [
    (Category::Events.name(), "Initialization, end and reset of a simulation"),
    (Category::StatusWarning.name(), "Something odd that does no harm"),
    (Category::StatusError.name(), "A call that failed, and why"),
    (ALL, "All messages"),
];

const ALL: &str = "logAll";

/// Categories of the standard that hosts may switch although no message ever belongs to them.
const UNUSED: [&str; 6] = [
    "logSingularLinearSystems",
    "logNonlinearSystems",
    "logDynamicStateSelection",
    "logStatusDiscard",
    "logStatusFatal",
    "logStatusPending",
];

impl Category {
    const EACH: [Self; 3] = [Self::Events, Self::StatusWarning, Self::StatusError];

    /// Name in the standard.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Events => "logEvents",
            Self::StatusWarning => "logStatusWarning",
            Self::StatusError => "logStatusError",
        }
    }

    fn status(self) -> Status {
        match self {
            Self::Events => Status::Ok,
            Self::StatusWarning => Status::Warning,
            Self::StatusError => Status::Error,
        }
    }

    /// Name with a terminating zero.
    fn c_name(self) -> *const std::ffi::c_char {
        match self {
            Self::Events => c"logEvents",
            Self::StatusWarning => c"logStatusWarning",
            Self::StatusError => c"logStatusError",
        }
        .as_ptr()
    }
}

/// The way to the host's log for one instance.
///
/// Callback, environment and name are copies: the host's structures need to live only as long as the
/// call that instantiates.
pub struct Logger {
    callback: Option<LoggerCallback>,
    environment: ComponentEnvironment,
    instance_name: CString,
    enabled: [bool; Category::EACH.len()],
}

impl Logger {
    /// A logger for the instance of this name; silent without callbacks.
    ///
    /// `logging_on` is about debug logging. Why a call failed is no debug message: errors are reported
    /// in any case, until the host switches them off by [`Logger::switch`].
    #[must_use]
    pub fn new(callbacks: Option<&CallbackFunctions>, instance_name: &str, logging_on: bool) -> Self {
        Self {
            callback: callbacks.and_then(|callbacks| callbacks.logger),
            environment: callbacks.map_or(ptr::null_mut(), |callbacks| callbacks.component_environment),
            instance_name: c_string(instance_name),
            enabled: Category::EACH.map(|category| logging_on || category == Category::StatusError),
        }
    }

    /// Switches the named categories, or all of them if none is named. A category that is unknown, or has no name,
    /// is passed over with a warning: what a host would like to hear is no reason to end a simulation.
    pub fn switch<'a>(&mut self, host: &Host, on: bool, names: &[Option<impl AsRef<str> + 'a>]) {
        let known = |name: &str| CATEGORIES.iter().any(|category| category.0 == name) || UNUSED.contains(&name);
        let named = || names.iter().flatten().map(AsRef::as_ref);
        for (category, enabled) in Category::EACH.into_iter().zip(&mut self.enabled) {
            if names.is_empty() || named().any(|name| name == category.name() || name == ALL) {
                *enabled = on;
            }
        }
        let nameless = names.iter().any(Option::is_none).then_some("NULL");
        let unknown = named().filter(|name| !known(name)).map(|name| Cow::from(format!("\"{name}\"")));
        for found in unknown.chain(nameless.map(Cow::from)) {
            let categories = CATEGORIES.map(|category| category.0).join(", ");
            self.log(
                host,
                Category::StatusWarning,
                format_args!("fmi2SetDebugLogging: categories are {categories}; {found} is passed over"),
            );
        }
    }

    /// Hands a message over, if its category is enabled; nothing is composed otherwise.
    pub fn log(&self, host: &Host, category: Category, message: impl Display) {
        if !self.enabled[category as usize] {
            return;
        }
        let Some(callback) = self.callback else { return };

        // The standard reads # as the beginning of a value reference; ## stands for itself.
        let text = c_string(&message.to_string().replace('#', "##"));
        // Hosts whose callback cannot read variable arguments show the format itself. So a message in
        // which nothing would be formatted is its own format, and is there as argument nevertheless.
        let format = if text.as_bytes().contains(&b'%') { c"%s" } else { text.as_c_str() };
        // SAFETY: the host vouches for its callback; all texts end with a zero and outlive the call.
        host.visit(|| unsafe {
            callback(
                self.environment,
                self.instance_name.as_ptr(),
                category.status(),
                category.c_name(),
                format.as_ptr(),
                text.as_ptr(),
            );
        });
    }
}

/// Text for C; a zero inside of it would end it early and is left out.
fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', "")).unwrap_or_default()
}
