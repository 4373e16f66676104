//! Syntax tree of a specification file, before name resolution.

use super::formula::Formula;
use petril_base::source::Span;

/// Name with its position.
#[derive(Clone, Debug)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Position.
    pub span: Span,
}

/// Contents of a file. Positions refer to the file's own zones and functions.
#[derive(Clone, Debug, Default)]
pub struct Written {
    /// `system "…";`
    pub titles: Vec<Name>,
    /// Zones: name and title.
    pub zones: Vec<(Name, Option<String>)>,
    /// Functions.
    pub functions: Vec<WrittenFunction>,
    /// Inputs, both outside functions and in their interfaces.
    pub inputs: Vec<WrittenInput>,
    /// Restrictions.
    pub restrictions: Vec<WrittenRestriction>,
}

/// `function F1 "…" { … }`
#[derive(Clone, Debug)]
pub struct WrittenFunction {
    pub name: Name,
    pub title: Option<String>,
    pub zone: Option<usize>,
    pub informal: Vec<(String, String)>,
    pub outputs: Vec<WrittenOutput>,
    pub equations: Vec<(Name, Formula<Name>)>,
}

/// `input DOOR "…" at %IX0.0 normally TRUE;`
#[derive(Clone, Debug)]
pub struct WrittenInput {
    pub name: Name,
    pub description: Option<String>,
    pub binding: Option<WrittenBinding>,
    pub rest: Option<bool>,
    pub function: Option<usize>,
}

/// `output F1 "…" is Interlock latched until RESET;`
#[derive(Clone, Debug)]
pub struct WrittenOutput {
    pub name: Name,
    pub description: Option<String>,
    pub binding: Option<WrittenBinding>,
    pub latched: Option<Formula<Name>>,
    pub delayed: Option<u32>,
}

/// `restriction R1 "…": never …;`
#[derive(Clone, Debug)]
pub struct WrittenRestriction {
    pub name: Name,
    pub sentence: Option<String>,
    pub zone: Option<usize>,
    pub function: Option<usize>,
    pub allowed: Formula<Name>,
    pub text: String,
}

/// `is Valve`, `at %IX0.0`
#[derive(Clone, Debug)]
pub enum WrittenBinding {
    Variable(Name),
    Address(Name),
}
