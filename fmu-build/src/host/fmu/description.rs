//! What the model description says, as far as a master needs it.

use std::fmt;
use std::str::FromStr;

use roxmltree::{Document, Node};

/// Type of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DataType {
    /// A real number.
    Real,
    /// A whole number.
    Integer,
    /// A truth value.
    Boolean,
    /// A text.
    String,
    /// One of a list of items.
    Enumeration,
}

impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

/// The part a variable plays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    /// Set by the user.
    Parameter,
    /// Follows from parameters.
    CalculatedParameter,
    /// Comes from outside.
    Input,
    /// Goes outside.
    Output,
    /// For information.
    Local,
    /// Time.
    Independent,
}

/// One variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Name.
    pub name: String,
    /// Number by which the C interface knows it.
    pub value_reference: u32,
    /// Type.
    pub data_type: DataType,
    /// The part it plays.
    pub causality: Causality,
    /// Unit, if it has one.
    pub unit: Option<String>,
    /// Start value as written.
    pub start: Option<String>,
}

/// An FMI 2.0 co-simulation unit, described.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Name of the model.
    pub model_name: String,
    /// Name of the library.
    pub model_identifier: String,
    /// Identity, to be handed to the library.
    pub guid: String,
    /// All variables in their order.
    pub variables: Vec<Variable>,
}

/// What is wrong with a model description.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Not even XML.
    #[error(transparent)]
    Xml(#[from] roxmltree::Error),
    /// Another version of the standard.
    #[error("fmiVersion must be 2.0, but is {0}")]
    Version(String),
    /// No co-simulation.
    #[error("it has no element CoSimulation: only co-simulation units can be run here")]
    Kind,
    /// An attribute is missing.
    #[error("element {element} at {at} lacks the attribute {attribute}")]
    Missing {
        /// Name of the element.
        element: String,
        /// Name of the attribute.
        attribute: &'static str,
        /// Line and column.
        at: roxmltree::TextPos,
    },
    /// An attribute or an element that the standard does not know.
    #[error("{what} {found:?} at {at} is not in FMI 2.0")]
    Unknown {
        /// What it is.
        what: &'static str,
        /// How it reads.
        found: String,
        /// Line and column.
        at: roxmltree::TextPos,
    },
}

impl Description {
    /// Reads a `modelDescription.xml`.
    ///
    /// # Errors
    /// If it does not describe an FMI 2.0 co-simulation unit.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let document = Document::parse(text)?;
        let root = document.root_element();
        let version = attribute(root, "fmiVersion")?;
        if version != "2.0" {
            return Err(Error::Version(version.to_owned()));
        }
        let co_simulation = child(root, "CoSimulation").ok_or(Error::Kind)?;
        let variables = child(root, "ModelVariables")
            .iter()
            .flat_map(Node::children)
            .filter(|node| node.has_tag_name("ScalarVariable"))
            .map(Variable::parse)
            .collect::<Result<_, _>>()?;
        Ok(Self {
            model_name: attribute(root, "modelName")?.to_owned(),
            model_identifier: attribute(co_simulation, "modelIdentifier")?.to_owned(),
            guid: attribute(root, "guid")?.to_owned(),
            variables,
        })
    }

    /// The variable with this name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().find(|variable| variable.name == name)
    }

    /// The variable with this name.
    ///
    /// # Errors
    /// If there is none; says which name is nearest.
    pub fn get(&self, name: &str) -> Result<&Variable, super::Error> {
        self.find(name).ok_or_else(|| super::Error::unknown(self, name))
    }

    /// All variables that play this part.
    pub fn with(&self, causality: Causality) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(move |variable| variable.causality == causality)
    }
}

impl Variable {
    fn parse(node: Node<'_, '_>) -> Result<Self, Error> {
        let unknown = |what, found: &str| Error::Unknown { what, found: found.to_owned(), at: position(node) };
        let typed = node.children().find(Node::is_element).ok_or_else(|| unknown("a variable without type", ""))?;
        let data_type = match typed.tag_name().name() {
            "Real" => DataType::Real,
            "Integer" => DataType::Integer,
            "Boolean" => DataType::Boolean,
            "String" => DataType::String,
            "Enumeration" => DataType::Enumeration,
            other => return Err(unknown("the type", other)),
        };
        let causality = match node.attribute("causality") {
            Some("parameter") => Causality::Parameter,
            Some("calculatedParameter") => Causality::CalculatedParameter,
            Some("input") => Causality::Input,
            Some("output") => Causality::Output,
            Some("local") | None => Causality::Local,
            Some("independent") => Causality::Independent,
            Some(other) => return Err(unknown("the causality", other)),
        };
        let reference = attribute(node, "valueReference")?;
        Ok(Self {
            name: attribute(node, "name")?.to_owned(),
            value_reference: u32::from_str(reference).map_err(|_| unknown("the value reference", reference))?,
            data_type,
            causality,
            unit: typed.attribute("unit").map(str::to_owned),
            start: typed.attribute("start").map(str::to_owned),
        })
    }
}

fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    node.children().find(|child| child.has_tag_name(name))
}

fn attribute<'a>(node: Node<'a, '_>, name: &'static str) -> Result<&'a str, Error> {
    node.attribute(name).ok_or_else(|| Error::Missing {
        element: node.tag_name().name().to_owned(),
        attribute: name,
        at: position(node),
    })
}

fn position(node: Node<'_, '_>) -> roxmltree::TextPos {
    node.document().text_pos_at(node.range().start)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(version: &str, variables: &str) -> String {
        format!(
            r#"<?xml version="1.0"?><fmiModelDescription fmiVersion="{version}" modelName="m" guid="g">
            <CoSimulation modelIdentifier="id"/><ModelVariables>{variables}</ModelVariables></fmiModelDescription>"#
        )
    }

    #[test]
    fn reads_variables() {
        let text = document(
            "2.0",
            r#"<ScalarVariable name="a" valueReference="7" causality="output"><Real unit="m"/></ScalarVariable>
               <ScalarVariable name="b" valueReference="8" causality="input"><Boolean start="true"/></ScalarVariable>"#,
        );
        let description = Description::parse(&text).unwrap();
        assert_eq!(description.model_identifier, "id");
        assert_eq!(description.find("a").unwrap().unit.as_deref(), Some("m"));
        let b = description.get("b").unwrap();
        assert_eq!((b.value_reference, b.data_type, b.causality), (8, DataType::Boolean, Causality::Input));
        assert_eq!(b.start.as_deref(), Some("true"));
        assert_eq!(description.with(Causality::Output).count(), 1);
    }

    #[test]
    fn says_what_is_wrong() {
        let refusal = |text: &str| Description::parse(text).unwrap_err().to_string();
        assert!(refusal(&document("3.0", "")).contains("2.0, but is 3.0"));
        assert!(!refusal("<a").is_empty());
        let lacking = r#"<ScalarVariable name="a"><Real/></ScalarVariable>"#;
        assert!(refusal(&document("2.0", lacking)).contains("valueReference"));
        let odd = r#"<ScalarVariable name="a" valueReference="-1"><Real/></ScalarVariable>"#;
        assert!(refusal(&document("2.0", odd)).contains("\"-1\""));
    }

    #[test]
    fn an_unknown_name_gets_a_hint() {
        let text = document("2.0", r#"<ScalarVariable name="base.x" valueReference="0"><Real/></ScalarVariable>"#);
        let error = Description::parse(&text).unwrap().get("base_x").unwrap_err();
        assert_eq!(error.to_string(), "m has no variable `base_x`; nearest is `base.x`");
    }
}
