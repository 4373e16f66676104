//! Type inference by unification: type variables are made equal step by step (union-find).
//!
//! A literal like `5` has no type of its own: it takes that of the operand it is used with.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::constant::{number, wider};
use super::program::TypeId;
use super::shape::{Enumeration, Scalar};
use crate::syntax::ast::{Constant, Literal};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::{Kind, Type};

/// Known type of a type variable, and the place that says so.
#[derive(Clone, Debug)]
pub struct Known {
    pub scalar: Scalar,
    pub span: Span,
}

impl Known {
    /// Whether the language determines the type, and no place in the text.
    pub fn is_nowhere(&self) -> bool {
        self.span == NOWHERE
    }
}

/// Span of a type that no place in the text determines.
pub const NOWHERE: Span = Span { start: 0, end: 0 };

/// Class of types that an operator accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// `BOOL`, `BYTE`, ….
    Bits,
    /// Integers and `TIME`.
    Magnitudes,
    /// Integers.
    Integers,
    /// Types with an order: all but enumerations.
    Ordered,
}

impl Class {
    fn has(self, scalar: &Scalar) -> bool {
        let kind = scalar.ty.kind;
        scalar.enumeration.is_none()
            && match self {
                Self::Bits => kind == Kind::Bits,
                Self::Magnitudes => kind != Kind::Bits,
                Self::Integers => matches!(kind, Kind::Signed | Kind::Unsigned),
                Self::Ordered => true,
            }
    }

    /// Whether the value of an operator can differ between two types of the class that both have the operands: a result
    /// may overflow, or a complement, shift or rotation reaches the highest bit.
    fn depends_on_type(self, operator: &str) -> bool {
        let operators: &[&str] = match self {
            Self::Bits => &["NOT", "LDN", "ORN", "XORN", "SHL", "ROL", "ROR"],
            Self::Magnitudes | Self::Integers => &["ADD", "SUB", "MUL", "DIV", "MOD", "ABS"],
            Self::Ordered => &[],
        };
        operators.iter().any(|word| word.eq_ignore_ascii_case(operator))
    }
}

/// Type variables and the constraints on them.
#[derive(Default)]
pub struct Inference {
    parent: Vec<usize>,
    known: Vec<Option<Known>>,
    classes: Vec<(usize, Class, Span, String)>,
    literals: Vec<(usize, Constant)>,
}

impl Inference {
    /// Adds an unconstrained type variable.
    pub fn fresh(&mut self) -> TypeId {
        self.parent.push(self.parent.len());
        self.known.push(None);
        TypeId(self.parent.len() - 1)
    }

    /// Adds the type of a variable. Of a subrange only the base type counts.
    pub fn of(&mut self, scalar: &Scalar, span: Span) -> TypeId {
        let id = self.fresh();
        let range = if scalar.enumeration.is_some() { scalar.range } else { None };
        self.known[id.0] = Some(Known { scalar: Scalar { range, ..scalar.clone() }, span });
        id
    }

    /// Adds the type `BOOL`.
    pub fn boolean(&mut self, span: Span) -> TypeId {
        self.of(&Scalar::new(Type::BOOL), span)
    }

    /// Adds the type of a literal; returns it with the position among the literals.
    pub fn literal(
        &mut self,
        constant: &Constant,
        enumeration: impl Fn(&str) -> Option<Rc<Enumeration>>,
    ) -> (TypeId, usize) {
        let id = match &constant.literal {
            Some(Literal::Boolean(_)) => self.boolean(constant.span),
            Some(Literal::Time(_)) => self.of(&Scalar::new(Type::TIME), constant.span),
            Some(Literal::Typed(name, _)) => match Type::named(name) {
                Some(ty) => self.of(&Scalar::new(ty), constant.span),
                None => self.fresh(),
            },
            Some(Literal::Enumerated(name, _)) => match enumeration(name) {
                Some(enumeration) => self.of(&Scalar::enumerated(enumeration), constant.span),
                None => self.fresh(),
            },
            _ => self.fresh(),
        };
        self.literals.push((id.0, constant.clone()));
        (id, self.literals.len() - 1)
    }

    /// Requires that a type be of a class, for an operator.
    pub fn demand(&mut self, id: TypeId, class: Class, span: Span, operator: impl Into<String>) {
        self.classes.push((id.0, class, span, operator.into()));
    }

    fn root(&mut self, mut at: usize) -> usize {
        while self.parent[at] != at {
            self.parent[at] = self.parent[self.parent[at]];
            at = self.parent[at];
        }
        at
    }

    /// Unifies two types: makes them equal.
    ///
    /// # Errors
    /// The known types of both, if they differ.
    pub fn unify(&mut self, a: TypeId, b: TypeId) -> Result<(), Box<(Known, Known)>> {
        let (a, b) = (self.root(a.0), self.root(b.0));
        if let (Some(left), Some(right)) = (&self.known[a], &self.known[b])
            && (left.scalar.ty, &left.scalar.enumeration) != (right.scalar.ty, &right.scalar.enumeration)
        {
            return Err(Box::new((left.clone(), right.clone())));
        }
        if a != b {
            // Of two places, the first in the text is reported.
            let later = match (&self.known[a], &self.known[b]) {
                (Some(left), Some(right)) => !right.is_nowhere() && (left.is_nowhere() || right.span < left.span),
                (left, _) => left.is_none(),
            };
            if later {
                self.known[a] = self.known[b].take();
            }
            self.parent[b] = a;
        }
        Ok(())
    }

    /// Solves the constraints: returns every type, the patterns of the literals, and diagnostics.
    pub fn settle(mut self) -> (Vec<Type>, Vec<u64>, Vec<Diagnostic>) {
        let mut found = self.defaults();
        for (at, class, span, operator) in std::mem::take(&mut self.classes) {
            let root = self.root(at);
            if let Some(known) = self.known[root].as_ref().filter(|known| !class.has(&known.scalar)) {
                let message = format!("`{operator}` has no meaning for `{}`", known.scalar);
                let diagnostic = Diagnostic::new(Code::OperatorUnfit, span, message);
                let diagnostic = if known.span == span || known.is_nowhere() {
                    diagnostic
                } else {
                    diagnostic.also(known.span, format!("of type `{}`", known.scalar))
                };
                found.push(diagnostic.help(advice(class, &known.scalar)));
            }
        }
        let mut patterns = Vec::new();
        for (at, constant) in std::mem::take(&mut self.literals) {
            let root = self.root(at);
            let scalar =
                self.known[root].as_ref().map_or_else(|| Scalar::new(Type::BOOL), |known| known.scalar.clone());
            match number(&constant, &scalar) {
                Ok(number) => patterns.push(scalar.ty.pattern(number)),
                Err(why) => {
                    patterns.push(0);
                    let message = format!("`{}` {why}", constant.text);
                    let diagnostic = Diagnostic::new(Code::LiteralUnfit, constant.span, message);
                    found.push(match wider(&constant, &scalar) {
                        _ if scalar.ty.is_bool() => {
                            diagnostic.help("Boolean literals are `TRUE` and `FALSE`, or `1` and `0`")
                        }
                        Some(ty) => diagnostic.help(format!("the type `{ty}` has it")),
                        None if scalar.ty == Type::TIME && matches!(constant.literal, Some(Literal::Integer(_))) => {
                            diagnostic.help(format!("write a time, like `T#{}ms`", constant.text))
                        }
                        None => diagnostic,
                    });
                }
            }
        }
        let types = (0..self.parent.len()).map(|at| {
            let root = self.root(at);
            self.known[root].as_ref().map_or(Type::BOOL, |known| known.scalar.ty)
        });
        (types.collect(), patterns, found)
    }

    /// Defaults of literals that meet no operand with a type: `INT`, or the first larger type that has them all; with
    /// operators on bits, the first type of bits. A warning is given where an operator's value depends on the type.
    fn defaults(&mut self) -> Vec<Diagnostic> {
        let mut open: BTreeMap<usize, (Vec<i128>, Constant)> = BTreeMap::new();
        for i in 0..self.literals.len() {
            let root = self.root(self.literals[i].0);
            if self.known[root].is_none()
                && let Some(Literal::Integer(number)) = self.literals[i].1.literal
            {
                open.entry(root).or_insert((Vec::new(), self.literals[i].1.clone())).0.push(number);
            }
        }
        let mut bits = BTreeSet::new();
        let mut depends: BTreeMap<usize, (Span, String)> = BTreeMap::new();
        for k in 0..self.classes.len() {
            let (at, class, span, operator) = self.classes[k].clone();
            let root = self.root(at);
            if class == Class::Bits {
                bits.insert(root);
            }
            if class.depends_on_type(&operator) {
                depends.entry(root).or_insert((span, operator));
            }
        }
        let mut found = Vec::new();
        for (root, (numbers, first)) in open {
            let candidates: &[&str] = if bits.contains(&root) {
                &["BOOL", "BYTE", "WORD", "DWORD", "LWORD"]
            } else {
                &["INT", "DINT", "LINT", "ULINT"]
            };
            let mut fitting = candidates.iter().filter_map(|name| Type::named(name));
            let ty = fitting.find(|ty| numbers.iter().all(|&number| ty.holds(number)));
            if let (Some(ty), Some((span, operator))) = (ty, depends.get(&root)) {
                let message = format!("nothing says of which type `{}` is, so `{ty}` is taken", first.text);
                let example = if ty.is_bool() { Type::new(Kind::Bits, 16) } else { ty };
                found.push(
                    Diagnostic::new(Code::LiteralWithoutType, first.span, message)
                        .also(*span, format!("the value of `{operator}` depends on the type"))
                        .help(format!("say which one is meant, like `{example}#{}`", first.text)),
                );
            }
            self.known[root] = ty.map(|ty| Known { scalar: Scalar::new(ty), span: first.span });
        }
        found
    }
}

/// Help where an operator has no meaning for a type.
fn advice(class: Class, scalar: &Scalar) -> String {
    let (ty, width) = (scalar.ty, scalar.ty.width);
    let named = |kind| Type::new(kind, width);
    match class {
        _ if scalar.enumeration.is_some() => "values of an enumeration are only compared with `EQ` and `NE`".to_owned(),
        Class::Bits if ty.kind == Kind::Time => "bits are of types BOOL, BYTE, WORD, DWORD, LWORD".to_owned(),
        Class::Bits => format!("convert it with `{ty}_TO_{}` first", named(Kind::Bits)),
        _ if ty.is_bool() => "it needs a number; `BOOL_TO_INT` makes one".to_owned(),
        _ if ty.kind == Kind::Bits => format!("convert it with `{ty}_TO_{}` first", named(Kind::Unsigned)),
        _ => "times are added, subtracted and compared; convert them with `TIME_TO_DINT` for more".to_owned(),
    }
}
