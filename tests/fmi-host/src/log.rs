//! What units say to the host's logger.

use std::cell::RefCell;
use std::sync::Once;

use log::{Level, LevelFilter, Metadata, Record};

thread_local! {
    /// Name of the instance, level and text of every message in this thread.
    static SAID: RefCell<Vec<(String, Level, String)>> = const { RefCell::new(Vec::new()) };
}

struct Collector;

impl log::Log for Collector {
    fn enabled(&self, _: &Metadata) -> bool {
        true
    }

    fn log(&self, record: &Record) {
        // The crate's own messages carry the path of a module; those of units the constant "logger".
        if record.module_path() == Some("logger") {
            let message = (record.target().to_owned(), record.level(), record.args().to_string());
            SAID.with_borrow_mut(|said| said.push(message));
        }
    }

    fn flush(&self) {}
}

/// The messages of all units in this thread from its creation on.
#[derive(Debug)]
pub struct Messages(());

impl Messages {
    /// Begins to listen.
    #[must_use]
    pub fn listen() -> Self {
        static INSTALL: Once = Once::new();
        INSTALL.call_once(|| {
            // Nobody else installs a logger in these tests.
            let _ = log::set_logger(&Collector);
            log::set_max_level(LevelFilter::Trace);
        });
        SAID.take();
        Self(())
    }

    /// What was said since the last question: instance, level and text.
    #[must_use]
    pub fn take(&self) -> Vec<(String, Level, String)> {
        SAID.take()
    }

    /// The texts of all errors of an instance since the last question, as one.
    #[must_use]
    pub fn errors_of(&self, instance: &str) -> String {
        let errors = self.take().into_iter().filter(|(name, level, _)| name == instance && *level == Level::Error);
        errors.map(|(_, _, text)| text).collect::<Vec<_>>().join("\n")
    }
}
