//! XML documents: declaration, indentation and how values are spelled.

use std::borrow::Cow;
use std::io;

use quick_xml::events::{BytesDecl, Event};
use quick_xml::writer::{ElementWriter, Writer};
use uam::variables::unit::PhysicalUnit;

use crate::error::{Error, Result};

/// Where elements are written to.
pub type Xml = Writer<Vec<u8>>;

/// A document with the elements that `content` writes; `name` is for errors.
pub fn document(name: &str, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> Result<String> {
    let write = || -> io::Result<String> {
        let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
        xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        content(&mut xml)?;
        let mut text = String::from_utf8(xml.into_inner()).map_err(io::Error::other)?;
        if let Some(c) = text.chars().find(|c| !is_allowed(*c)) {
            return Err(io::Error::other(format!("XML has no character U+{:04X}", u32::from(c))));
        }
        text.push('\n');
        Ok(text)
    };
    write().map_err(|reason| Error::Document { document: name.to_owned(), reason: reason.to_string() })
}

/// Whether XML 1.0 allows a character; not even escaped does it allow the others.
fn is_allowed(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..)
}

/// An element with every attribute on a line of its own.
pub fn tall_element<'a>(
    xml: &'a mut Xml,
    name: &'static str,
    attributes: impl IntoIterator<Item = (&'static str, &'a str)>,
) -> ElementWriter<'a, Vec<u8>> {
    attributes
        .into_iter()
        .fold(xml.create_element(name), |element, attribute| element.new_line().with_attribute(attribute))
}

/// An element that holds an element for each of these.
pub fn list<T>(
    xml: &mut Xml,
    name: &str,
    items: impl IntoIterator<Item = T>,
    mut write: impl FnMut(&mut Xml, T) -> io::Result<()>,
) -> io::Result<()> {
    xml.create_element(name).holding(|xml| items.into_iter().try_for_each(|item| write(xml, item)))
}

/// How an element ends.
pub trait Ending {
    /// Without content.
    fn empty(self) -> io::Result<()>;
    /// Behind the content that is written by this.
    fn holding(self, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<()>;
}

impl Ending for ElementWriter<'_, Vec<u8>> {
    fn empty(self) -> io::Result<()> {
        self.write_empty().map(|_| ())
    }

    fn holding(self, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<()> {
        self.write_inner_content(content).map(|_| ())
    }
}

/// The shortest spelling that is read back as the same number.
pub fn number(value: f64) -> Cow<'static, str> {
    value.to_string().into()
}

/// An integer in decimal digits.
pub fn integer(value: i32) -> Cow<'static, str> {
    value.to_string().into()
}

/// A truth value.
pub fn truth(value: bool) -> &'static str {
    if value { "true" } else { "false" }
}

/// The exponents of a unit's base units other than 0, as attributes of a `BaseUnit` element.
pub fn base_exponents(unit: &PhysicalUnit) -> impl Iterator<Item = (&'static str, Cow<'static, str>)> {
    [("kg", unit.kg), ("m", unit.m), ("s", unit.s), ("rad", unit.rad)]
        .into_iter()
        .filter(|(_, exponent)| *exponent != 0)
        .map(|(base, exponent)| (base, integer(exponent.into())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_bit_by_bit() {
        for value in [0.0, -0.0, 0.1, 1e-4, -1.0 / 3.0, f64::MIN_POSITIVE, f64::MAX, 57.29577951308232] {
            assert_eq!(number(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
    }

    #[test]
    fn what_has_a_meaning_in_xml_is_escaped() {
        let text = document("test", |xml| xml.create_element("a").with_attribute(("b", "<\"&'>")).empty());
        let text = text.unwrap();
        let parsed = roxmltree::Document::parse(&text).unwrap();
        assert_eq!(parsed.root_element().attribute("b"), Some("<\"&'>"));
    }

    #[test]
    fn what_xml_cannot_say_is_refused() {
        let written =
            |c: char| document("test", |xml| xml.create_element("a").with_attribute(("b", &*c.to_string())).empty());
        for c in ['\0', '\u{7}', '\u{1B}', '\u{1F}', '\u{FFFE}', '\u{FFFF}'] {
            let refused = written(c).unwrap_err().to_string();
            assert_eq!(refused, format!("cannot put together test: XML has no character U+{:04X}", u32::from(c)));
        }
        for c in (0..=u32::from(char::MAX)).step_by(97).filter_map(char::from_u32) {
            let parsed = written(c).ok().map(|text| roxmltree::Document::parse(&text).map(|_| ()));
            assert!(parsed.is_none_or(|parsed| parsed.is_ok()), "{c:?}");
        }
    }
}
