//! Resolution of paths like `pump.T.Q` and `level[i]` to places.

use super::Typing;
use crate::semantics::address;
use crate::semantics::program::{Index, Operand, Place, Root, Step, TypeId};
use crate::semantics::shape::{Scalar, Shape};
use crate::semantics::symbols::Section;
use crate::syntax::ast::{self, Literal, Name, Part, Path, Subscript};
use crate::syntax::standard_address;
use petril_base::Kind;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Use of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    Read,
    Write,
    /// Bound to an in-out variable.
    Bind,
}

impl Typing<'_> {
    /// Resolves an elementary variable, or a value of an enumeration, to be read.
    pub fn readable(&mut self, path: &Path) -> Option<(TypeId, Operand)> {
        let context = self.context;
        let is_variable = context.project.variable(context.id, &path.root.text).is_some();
        if let (false, Some(name)) = (is_variable, path.plain()) {
            let enumerators = context.project.enumerators(&name.text);
            if let [(enumeration, _)] = enumerators.as_slice() {
                let scalar = Scalar::enumerated(enumeration.clone());
                let text = format!("{}#{}", enumeration.name, name.text);
                let literal = Literal::Enumerated(enumeration.name.clone(), name.text.clone());
                let constant = ast::Constant { text, literal: Some(literal), span: name.span };
                let (ty, position) = self.types.literal(&constant, |_| scalar.enumeration.clone());
                return Some((ty, Operand::Literal(position)));
            } else if !enumerators.is_empty() {
                let names: Vec<String> =
                    enumerators.iter().map(|(e, _)| format!("`{}#{}`", e.name, name.text)).collect();
                let message = format!("`{}` is a value of several enumerations", name.text);
                let help = format!("say which one is meant, like {}", names.join(" or "));
                self.diagnostics.push(Diagnostic::new(Code::NameNotDeclared, name.span, message).help(help));
                return None;
            }
        }
        let place = self.place(path, Use::Read)?;
        let ty = self.elementary(&place, path)?;
        Some((ty, Operand::Place(place)))
    }

    /// Resolves an elementary variable to be written.
    pub fn writable(&mut self, operand: &ast::Operand, operator: &str) -> Option<(TypeId, Place)> {
        let path = match operand {
            ast::Operand::Variable(path) => path,
            ast::Operand::Constant(constant) => {
                let message = format!("`{operator}` writes its operand, so it must be a variable");
                self.diagnostics.push(Diagnostic::new(Code::OperandUnfit, constant.span, message));
                return None;
            }
        };
        let place = self.place(path, Use::Write)?;
        let ty = self.elementary(&place, path)?;
        Some((ty, place))
    }

    /// Type of an elementary place; reports others, which cannot be loaded or stored.
    pub fn elementary(&mut self, place: &Place, path: &Path) -> Option<TypeId> {
        let what = match &place.shape {
            Shape::Scalar(scalar) => return Some(self.types.of(scalar, place.span)),
            Shape::Array { .. } => "an array",
            Shape::Structure(_) => "a structure",
            Shape::Instance(_) => "an instance of a function block",
        };
        let message = format!("`{path}` is {what}, not one value");
        let help = match &place.shape {
            Shape::Instance(id) => {
                self.outputs(*id).first().map(|output| format!("name one of its outputs, like `{path}.{output}`"))
            }
            Shape::Structure(structure) => structure
                .members
                .first()
                .map(|member| format!("name one of its members, like `{path}.{}`", member.name)),
            _ => Some(format!("name one of its elements, like `{path}[1]`")),
        };
        let diagnostic = Diagnostic::new(Code::OperandUnfit, path.span, message);
        self.diagnostics.push(match help {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        });
        None
    }

    fn outputs(&self, id: crate::semantics::PouId) -> Vec<String> {
        let symbols = self.context.project.symbols(id).list().iter();
        symbols.filter(|symbol| symbol.section == Section::Output).map(|symbol| symbol.name.clone()).collect()
    }

    /// Resolves a path to a place. `None` has been reported.
    pub fn place(&mut self, path: &Path, used: Use) -> Option<Place> {
        let context = self.context;
        let Some((section, position, symbol)) = context.project.variable(context.id, &path.root.text) else {
            self.unknown_root(path);
            return None;
        };
        let root = match section {
            Section::External(global) => Root::Global(global),
            _ => Root::Own(position),
        };
        // A broken declaration has no shape, and has been reported.
        let mut shape = symbol.shape.clone()?;
        let mut steps = Vec::new();
        let mut so_far = path.root.text.clone();
        for (i, part) in path.parts.iter().enumerate() {
            let is_last = i + 1 == path.parts.len();
            match part {
                Part::Member(name) => {
                    let (position, next) =
                        self.member(&shape, name, &so_far, if is_last { used } else { Use::Read })?;
                    steps.push(Step::Member(position));
                    shape = next;
                    so_far = format!("{so_far}.{}", name.text);
                }
                Part::Index(indices, span) => {
                    let (step, next) = self.element(&shape, indices, *span, &so_far)?;
                    steps.push(step);
                    shape = next;
                    so_far += "[…]";
                }
            }
        }
        let place = Place { root, steps, shape, span: path.span };
        self.regular(&place, path)?;
        Some(place)
    }

    fn unknown_root(&mut self, path: &Path) {
        if path.root.text.starts_with('%') {
            self.diagnostics.push(address::unreadable(&path.root));
            return;
        }
        if !path.parts.is_empty() && standard_address(&path.to_string()).is_some() {
            let whole = Name { text: path.to_string(), span: path.span };
            self.diagnostics.push(address::unreadable(&whole));
            return;
        }
        self.unknown.entry(path.root.key()).or_insert((path.root.clone(), 0)).1 += 1;
    }

    fn member(&mut self, shape: &Shape, name: &Name, whole: &str, used: Use) -> Option<(usize, Shape)> {
        let mut unknown = |what: String, names: Vec<&str>| {
            let message = format!("{what} has no part `{}`", name.text);
            let list = names.iter().take(12).copied().collect::<Vec<_>>().join(", ");
            let diagnostic = Diagnostic::new(Code::MemberUnknown, name.span, message).suggest(&name.text, names);
            self.diagnostics.push(if list.is_empty() { diagnostic } else { diagnostic.help(format!("it has {list}")) });
            None
        };
        match shape {
            Shape::Structure(structure) => {
                let members = &structure.members;
                match members.iter().position(|member| member.name.eq_ignore_ascii_case(&name.text)) {
                    Some(position) => Some((position, members[position].shape.clone())),
                    None => unknown(format!("`{whole}`"), members.iter().map(|member| member.name.as_str()).collect()),
                }
            }
            Shape::Instance(id) => {
                let symbols = self.context.project.symbols(*id);
                let Some((position, symbol)) = symbols.find(&name.text) else {
                    let seen = symbols.list().iter().filter(|s| matches!(s.section, Section::Input | Section::Output));
                    return unknown(format!("`{whole}`"), seen.map(|symbol| symbol.name.as_str()).collect());
                };
                let allowed = match (symbol.section, used) {
                    (Section::Input, _) | (Section::Output, Use::Read) => true,
                    (_, _) => false,
                };
                if !allowed {
                    let block = &self.context.project.pou(*id).name.text;
                    let (message, help) = match symbol.section {
                        Section::Output => (
                            format!("`{whole}.{}` is an output, and only `{block}` writes it", name.text),
                            "write its inputs, or copy it to a variable of your own",
                        ),
                        _ => (
                            format!("`{}` belongs to the inside of `{block}`", name.text),
                            "only inputs and outputs are seen from outside",
                        ),
                    };
                    let diagnostic = Diagnostic::new(Code::MemberHidden, name.span, message).help(help);
                    let is_library = self.context.project.is_library(*id);
                    self.diagnostics.push(if is_library {
                        diagnostic
                    } else {
                        diagnostic.also(symbol.span, "declared here")
                    });
                    return None;
                }
                Some((position, symbol.shape.clone()?))
            }
            Shape::Scalar(scalar) => unknown(format!("`{whole}` is of type `{scalar}` and"), Vec::new()),
            Shape::Array { .. } => unknown(format!("`{whole}` is an array and"), Vec::new()),
        }
    }

    fn element(&mut self, shape: &Shape, indices: &[Subscript], span: Span, whole: &str) -> Option<(Step, Shape)> {
        let Shape::Array { ranges, of } = shape else {
            let message = format!("`{whole}` is no array, so it has no elements");
            self.diagnostics.push(Diagnostic::new(Code::IndexCount, span, message));
            return None;
        };
        if ranges.len() != indices.len() {
            let dimensions = match ranges.len() {
                1 => "1 dimension".to_owned(),
                n => format!("{n} dimensions"),
            };
            let message = format!("`{whole}` has {dimensions}, but {} in brackets", count(indices.len()));
            let help = format!("it is {shape}");
            self.diagnostics.push(Diagnostic::new(Code::IndexCount, span, message).help(help));
            return None;
        }
        let indices =
            indices.iter().zip(ranges).map(|(index, &range)| self.index(index, range, whole)).collect::<Vec<_>>();
        Some((Step::Index(indices.into_iter().collect::<Option<_>>()?), (**of).clone()))
    }

    fn index(&mut self, index: &Subscript, (lower, upper): (i64, i64), whole: &str) -> Option<Index> {
        match index {
            Subscript::Constant(constant) => {
                let Some(Literal::Integer(number) | Literal::Typed(_, number)) = constant.literal else {
                    let message = format!("`{}` is no index", constant.text);
                    self.diagnostics.push(
                        Diagnostic::new(Code::IndexUnfit, constant.span, message).help("an index is a whole number"),
                    );
                    return None;
                };
                match i64::try_from(number).ok().filter(|number| (lower..=upper).contains(number)) {
                    Some(number) => Some(Index::Constant(number)),
                    None => {
                        let message =
                            format!("the index {number} is outside of `{whole}`, which goes from {lower} to {upper}");
                        self.diagnostics.push(Diagnostic::new(Code::IndexOutside, constant.span, message));
                        None
                    }
                }
            }
            Subscript::Variable(path) => {
                let place = self.place(path, Use::Read)?;
                self.elementary(&place, path)?;
                let scalar = place.scalar();
                let is_number = matches!(scalar.ty.kind, Kind::Signed | Kind::Unsigned) && scalar.enumeration.is_none();
                if !is_number {
                    let message = format!("`{path}` is of type `{scalar}` and can be no index");
                    self.diagnostics
                        .push(Diagnostic::new(Code::IndexUnfit, path.span, message).help("an index is a whole number"));
                    return None;
                }
                Some(Index::Variable(place))
            }
        }
    }

    /// Checks that elements selected by variables lie at equal distances, so that one number can select them.
    fn regular(&mut self, place: &Place, path: &Path) -> Option<()> {
        let is_variable = |step: &Step| matches!(step, Step::Index(indices) if indices.iter().any(|i| matches!(i, Index::Variable(_))));
        let variable: Vec<usize> = (0..place.steps.len()).filter(|&i| is_variable(&place.steps[i])).collect();
        let (Some(&first), Some(&last)) = (variable.first(), variable.last()) else { return Some(()) };
        let members_between = place.steps[first..last].iter().any(|step| matches!(step, Step::Member(_)));
        let message = if members_between {
            "indices before and behind a member cannot both be variables"
        } else if matches!(place.shape, Shape::Scalar(_)) {
            return Some(());
        } else {
            "an index that is a variable can only choose an elementary value"
        };
        let help = "use constants for the outer index, or an array for each member";
        self.diagnostics.push(Diagnostic::new(Code::IndexUnfit, path.span, message).help(help));
        None
    }
}

fn count(indices: usize) -> String {
    if indices == 1 { "1 index stands".to_owned() } else { format!("{indices} indices stand") }
}
