//! Conversion of XML elements to [`Formula`].
//!
//! Operators with many operands become balanced trees, so that recursion over formulas stays shallow.

use roxmltree::Node;

use super::reader::Reader;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::xml::{Text, tag, tag_span};
use petril_logic::{Comparison, Expression, Formula, Quantifier, Temporal};

/// Upper bound on the nesting of a formula, so that recursion stays within the stack. Formulas of the contest have
/// about twenty levels.
const MAX_DEPTH: u32 = 500;

/// Elements of Boolean type.
const TRUTHS: &[&str] = &[
    "exists-path",
    "all-paths",
    "negation",
    "conjunction",
    "disjunction",
    "exclusive-disjunction",
    "implication",
    "equivalence",
    "true",
    "false",
    "deadlock",
    "is-fireable",
    "integer-le",
    "integer-lt",
    "integer-eq",
    "integer-ne",
    "integer-ge",
    "integer-gt",
];

/// Elements of number type.
const NUMBERS: &[&str] = &["integer-constant", "tokens-count", "integer-sum", "integer-difference", "integer-product"];

/// Path operators.
const PATHS: &[&str] = &["finally", "globally", "next", "until"];

/// Reads an operand at a nesting depth.
type Read = fn(&mut Reader, Node<'_, '_>, u32) -> Option<Formula>;
type Join = fn(Box<Formula>, Box<Formula>) -> Expression;

impl Reader {
    /// Reads an element of Boolean type at a nesting depth.
    pub fn truth(&mut self, element: Node<'_, '_>, depth: u32) -> Option<Formula> {
        let expression = match tag(element) {
            "exists-path" => self.path(element, Quantifier::Some, depth)?,
            "all-paths" => self.path(element, Quantifier::All, depth)?,
            "negation" => {
                let [f] = self.operands(element)?;
                let depth = self.below(element, depth, 1)?;
                Expression::Not(Box::new(self.truth(f, depth)?))
            }
            "conjunction" => return self.several(element, depth, Self::truth, Expression::And),
            "disjunction" => return self.several(element, depth, Self::truth, Expression::Or),
            "implication" => self.two(element, depth, Self::truth, Expression::Implies)?,
            "equivalence" => self.two(element, depth, Self::truth, Expression::Iff)?,
            "exclusive-disjunction" => {
                // Negation adds a level.
                let expression = self.two(element, depth + 1, Self::truth, Expression::Iff)?;
                Expression::Not(Box::new(Formula { expression, span: tag_span(element) }))
            }
            constant @ ("true" | "false" | "deadlock") => {
                let [] = self.operands(element)?;
                if constant == "deadlock" { Expression::Deadlock } else { Expression::Truth(constant == "true") }
            }
            "is-fireable" => {
                let transitions = self.names(element, "transition")?;
                return balanced(atoms(transitions, Expression::Enabled), Expression::Or);
            }
            "integer-le" => self.compare(element, depth, |a, b| Expression::Compare(Comparison::AtMost, a, b))?,
            "integer-lt" => self.compare(element, depth, |a, b| Expression::Compare(Comparison::Less, a, b))?,
            "integer-eq" => self.compare(element, depth, |a, b| Expression::Compare(Comparison::Equal, a, b))?,
            "integer-ne" => self.compare(element, depth, |a, b| Expression::Compare(Comparison::Unequal, a, b))?,
            "integer-ge" => self.compare(element, depth, |a, b| Expression::Compare(Comparison::AtLeast, a, b))?,
            "integer-gt" => self.compare(element, depth, |a, b| Expression::Compare(Comparison::Greater, a, b))?,
            _ => {
                self.no_truth(element);
                return None;
            }
        };
        Some(Formula { expression, span: tag_span(element) })
    }

    /// Reads an element of number type at a nesting depth.
    fn number(&mut self, element: Node<'_, '_>, depth: u32) -> Option<Formula> {
        let expression = match tag(element) {
            "integer-constant" => {
                let Text { text, span } = self.text(element)?;
                let number = text.parse().ok().filter(|n| (i64::MIN.into()..=u64::MAX.into()).contains(n));
                if number.is_none() {
                    self.refuse(span, format!("`{text}` is no whole number of 64 bits"));
                }
                Expression::Number(number?)
            }
            "tokens-count" => {
                let places = self.names(element, "place")?;
                return balanced(atoms(places, Expression::Tokens), Expression::Sum);
            }
            "integer-sum" => return self.several(element, depth, Self::number, Expression::Sum),
            "integer-product" => return self.several(element, depth, Self::number, Expression::Product),
            "integer-difference" => self.two(element, depth, Self::number, Expression::Difference)?,
            name => {
                if TRUTHS.contains(&name) {
                    let message = format!("`<{name}>` is true or false, where a number is needed");
                    self.diagnostics.push(Diagnostic::new(Code::RequirementTypes, tag_span(element), message));
                } else {
                    self.unknown(element, NUMBERS);
                }
                return None;
            }
        };
        Some(Formula { expression, span: tag_span(element) })
    }

    /// Reads a path quantifier with its path operator.
    fn path(&mut self, element: Node<'_, '_>, quantifier: Quantifier, depth: u32) -> Option<Expression> {
        let [operator] = self.operands(element)?;
        let depth = self.below(element, depth, 1)?;
        let temporal = match tag(operator) {
            "next" => Temporal::Next,
            "finally" => Temporal::Finally,
            "globally" => Temporal::Globally,
            "until" => return self.until(operator, quantifier, depth),
            name => {
                if TRUTHS.contains(&name) {
                    self.linear(operator, format!("`<{}>` has no path operator directly in it", tag(element)));
                } else {
                    self.unknown(operator, PATHS);
                }
                return None;
            }
        };
        let [f] = self.operands(operator)?;
        Some(Expression::Temporal(quantifier, temporal, Box::new(self.truth(f, depth)?)))
    }

    /// Reads an until with operands at a nesting depth.
    fn until(&mut self, element: Node<'_, '_>, quantifier: Quantifier, depth: u32) -> Option<Expression> {
        let [before, reach] = self.operands(element)?;
        let mut operand = |part: Node<'_, '_>, name| {
            if tag(part) != name {
                self.unknown(part, &[name]);
                return None;
            }
            let [f] = self.operands(part)?;
            self.truth(f, depth).map(Box::new)
        };
        let (hold, release) = (operand(before, "before"), operand(reach, "reach"));
        Some(Expression::Until { quantifier, weak: false, hold: hold?, release: release? })
    }

    fn compare(&mut self, element: Node<'_, '_>, depth: u32, join: Join) -> Option<Expression> {
        self.two(element, depth, Self::number, join)
    }

    /// Reads an operator with two operands.
    fn two(&mut self, element: Node<'_, '_>, depth: u32, read: Read, join: Join) -> Option<Expression> {
        let [a, b] = self.operands(element)?;
        let depth = self.below(element, depth, 2)?;
        let (a, b) = (read(self, a, depth), read(self, b, depth));
        Some(join(Box::new(a?), Box::new(b?)))
    }

    /// Reads an operator with at least one operand.
    fn several(&mut self, element: Node<'_, '_>, depth: u32, read: Read, join: Join) -> Option<Formula> {
        let children = self.children(element);
        if children.is_empty() {
            self.refuse(tag_span(element), format!("this `<{}>` has no operands", tag(element)));
        }
        let depth = self.below(element, depth, children.len())?;
        let operands: Vec<Option<Formula>> = children.into_iter().map(|child| read(self, child, depth)).collect();
        balanced(operands.into_iter().collect::<Option<_>>()?, join)
    }

    /// Nesting depth of the operands of an element; `None` if that is too deep.
    fn below(&mut self, element: Node<'_, '_>, depth: u32, operands: usize) -> Option<u32> {
        let depth = depth + operands.next_power_of_two().ilog2().max(1);
        if depth <= MAX_DEPTH {
            return Some(depth);
        }
        let message = "this formula is nested more than 500 levels deep";
        if self.first(message) {
            self.refuse_with_help(tag_span(element), message, "split it into several properties");
        }
        None
    }

    /// Reports an element that is not of Boolean type.
    fn no_truth(&mut self, element: Node<'_, '_>) {
        let (name, span) = (tag(element), tag_span(element));
        if PATHS.contains(&name) {
            self.linear(element, format!("`<{name}>` stands in no quantifier of its own"));
        } else if NUMBERS.contains(&name) {
            let message = format!("`<{name}>` is a number, where something true or false is needed");
            let help = "compare it with something, like `<integer-le>`";
            self.diagnostics.push(Diagnostic::new(Code::RequirementTypes, span, message).help(help));
        } else if name == "place-bound" {
            let help = "put it directly into `<formula>`, or compare a `<tokens-count>`";
            self.refuse_with_help(span, "`<place-bound>` is a question of its own, not part of a formula", help);
        } else {
            self.unknown(element, TRUTHS);
        }
    }

    /// Rejects an LTL formula, once per property.
    fn linear(&mut self, element: Node<'_, '_>, here: String) {
        let message = "formulas of LTL are not read";
        if self.first(message) {
            let help = "in CTL, `<all-paths>` or `<exists-path>` stands directly around each of `<finally>`, `<globally>`, \
                        `<next>` and `<until>`";
            let diagnostic = Diagnostic::new(Code::RequirementSyntax, tag_span(element), message);
            self.diagnostics.push(diagnostic.here(here).help(help));
        }
    }
}

/// Atoms, one for each name.
fn atoms(names: Vec<Text>, atom: fn(String) -> Expression) -> Vec<Formula> {
    names.into_iter().map(|Text { text, span }| Formula { expression: atom(text), span }).collect()
}

/// Balanced tree over all formulas, in order.
fn balanced(mut formulas: Vec<Formula>, join: Join) -> Option<Formula> {
    while formulas.len() > 1 {
        let mut rest = formulas.into_iter();
        formulas = std::iter::from_fn(|| {
            let left = rest.next()?;
            let Some(right) = rest.next() else { return Some(left) };
            let span: Span = left.span.to(right.span);
            Some(Formula { expression: join(Box::new(left), Box::new(right)), span })
        })
        .collect();
    }
    formulas.pop()
}
