//! Variables that are read or written together, with one C call per type and names looked up only once.

use super::{DataType, Description, Error, Value};

/// Variables of one unit in a given order, sorted by type for the C interface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Selection {
    pub(super) reals: Vec<u32>,
    pub(super) integers: Vec<u32>,
    pub(super) booleans: Vec<u32>,
    places: Vec<Place>,
}

/// Where the value of a selected variable is found among the values of its type.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Real(usize),
    Integer(usize),
    Boolean(usize),
}

/// Values of the variables of a [`Selection`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Values {
    pub(super) reals: Vec<f64>,
    pub(super) integers: Vec<i32>,
    pub(super) booleans: Vec<i32>,
}

impl Selection {
    /// The variables with these names, in this order. Enumerations count as integers.
    ///
    /// # Errors
    /// If a name is unknown, or belongs to a text.
    pub fn new<'a>(description: &Description, names: impl IntoIterator<Item = &'a str>) -> Result<Self, Error> {
        let mut selection = Self::default();
        for name in names {
            let variable = description.get(name)?;
            let (list, place): (_, fn(usize) -> Place) = match variable.data_type {
                DataType::Real => (&mut selection.reals, Place::Real),
                DataType::Integer | DataType::Enumeration => (&mut selection.integers, Place::Integer),
                DataType::Boolean => (&mut selection.booleans, Place::Boolean),
                DataType::String => {
                    return Err(Error::Type {
                        unit: description.model_name.clone(),
                        name: name.to_owned(),
                        expected: variable.data_type,
                        found: "a number",
                    });
                }
            };
            selection.places.push(place(list.len()));
            list.push(variable.value_reference);
        }
        Ok(selection)
    }

    /// How many variables.
    #[must_use]
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Room for the values of these variables.
    #[must_use]
    pub fn values(&self) -> Values {
        Values {
            reals: vec![0.0; self.reals.len()],
            integers: vec![0; self.integers.len()],
            booleans: vec![0; self.booleans.len()],
        }
    }

    /// The values as plain numbers in the order of the names; truth is 1.
    pub fn numbers<'a>(&'a self, values: &'a Values) -> impl Iterator<Item = f64> + 'a {
        self.places.iter().map(|place| match *place {
            Place::Real(i) => values.reals[i],
            Place::Integer(i) => f64::from(values.integers[i]),
            Place::Boolean(i) => f64::from(values.booleans[i]),
        })
    }

    /// Puts `value` at the `index`-th name; `false`, and no change, if it is of another type.
    pub fn put(&self, values: &mut Values, index: usize, value: Value) -> bool {
        match (self.places.get(index), value) {
            (Some(&Place::Real(i)), Value::Real(value)) => values.reals[i] = value,
            (Some(&Place::Integer(i)), Value::Integer(value)) => values.integers[i] = value,
            (Some(&Place::Boolean(i)), Value::Boolean(value)) => values.booleans[i] = i32::from(value),
            _ => return false,
        }
        true
    }

    /// The value of the `index`-th name.
    #[must_use]
    pub fn value(&self, values: &Values, index: usize) -> Option<Value> {
        self.places.get(index).map(|place| match *place {
            Place::Real(i) => Value::Real(values.reals[i]),
            Place::Integer(i) => Value::Integer(values.integers[i]),
            Place::Boolean(i) => Value::Boolean(values.booleans[i] != 0),
        })
    }
}
