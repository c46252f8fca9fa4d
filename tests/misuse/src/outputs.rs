//! What instances show at communication points: numbers, or an error with the reason.

use std::ffi::c_int;
use std::fmt;

use crate::functions::{Component, ERROR, Functions, OK};
use crate::host;
use crate::unit::Variable;

/// Communication points at which outputs and their derivatives were read, and at how many of them either was refused.
///
/// So it must be where numbers have grown beyond all bounds; but a run in which it is the rule proves nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Points {
    pub read: u64,
    pub without_outputs: u64,
    pub without_derivatives: u64,
}

impl Points {
    /// Whether outputs are mostly there: of many points, at ninety-nine out of a hundred.
    ///
    /// # Errors
    /// If they are not.
    pub fn tell(&self) -> Result<(), String> {
        let missing = self.without_outputs + self.without_derivatives;
        if self.read < 1000 || 100 * missing <= self.read { Ok(()) } else { Err(format!("this proves little: {self}")) }
    }

    /// Of both.
    pub fn and(self, other: Self) -> Self {
        Self {
            read: self.read + other.read,
            without_outputs: self.without_outputs + other.without_outputs,
            without_derivatives: self.without_derivatives + other.without_derivatives,
        }
    }
}

impl fmt::Display for Points {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { read, without_outputs, without_derivatives } = self;
        write!(f, "outputs read {read} times, without values {without_outputs}, derivatives {without_derivatives}")
    }
}

/// Reads these variables, and the derivatives of the outputs among them, as long as that is possible, and gives the
/// numbers to `take`. `told`: the instance has a logger, and must say why it refuses.
///
/// # Errors
/// If a number is not finite, or something is refused for another reason than that numbers have no values any more.
pub fn read<'a>(
    functions: &Functions,
    component: Component,
    variables: impl Iterator<Item = &'a Variable> + Clone,
    told: bool,
    mut take: impl FnMut(f64),
) -> Result<Points, String> {
    let before = host::messages();
    let mut points = Points { read: 1, ..Points::default() };
    let refused = if values(functions, component, variables.clone(), &mut take)? == ERROR {
        points.without_outputs = 1;
        "fmi2GetReal"
    } else if derivatives(functions, component, variables, take)? == ERROR {
        points.without_derivatives = 1;
        "fmi2GetRealOutputDerivatives"
    } else {
        return Ok(points);
    };
    let said = host::said();
    if told && (host::messages() == before || !said.contains(&format!("{refused}: the outputs at"))) {
        return Err(format!("{refused} is refused: {said}"));
    }
    Ok(points)
}

/// Reads variables until one is refused; the last status.
///
/// # Errors
/// If a number is not finite, or a status is neither `fmi2OK` nor `fmi2Error`.
pub fn values<'a>(
    functions: &Functions,
    component: Component,
    variables: impl Iterator<Item = &'a Variable>,
    take: impl FnMut(f64),
) -> Result<c_int, String> {
    each(variables, "", take, |reference, value| {
        // SAFETY: the instance is alive, the lists have one element.
        unsafe { functions.get_real(component, reference, 1, value) }
    })
}

fn derivatives<'a>(
    functions: &Functions,
    component: Component,
    variables: impl Iterator<Item = &'a Variable>,
    take: impl FnMut(f64),
) -> Result<c_int, String> {
    let outputs = variables.filter(|variable| variable.output);
    each(outputs, "the derivative of ", take, |reference, value| {
        // SAFETY: as above.
        unsafe { functions.get_output_derivatives(component, reference, 1, &1, value) }
    })
}

fn each<'a>(
    variables: impl Iterator<Item = &'a Variable>,
    what: &str,
    mut take: impl FnMut(f64),
    get: impl Fn(*const u32, *mut f64) -> c_int,
) -> Result<c_int, String> {
    for Variable { reference, name, .. } in variables {
        let mut value = f64::NAN;
        match get(reference, &raw mut value) {
            OK if value.is_finite() => take(value),
            OK => return Err(format!("{what}{name} is {value}")),
            ERROR => return Ok(ERROR),
            status => return Err(format!("{what}{name}: status {status}")),
        }
    }
    Ok(OK)
}
