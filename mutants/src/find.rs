//! The faults of one source file.

use std::collections::HashSet;
use std::ops::Range;

use serde::{Deserialize, Serialize};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, BinOp, Block, Expr, Pat, Signature, Stmt, UnOp};

use crate::defaults;

/// What stands in the table of faults.
#[derive(Clone, Serialize, Deserialize)]
pub struct Fault {
    pub number: u32,
    pub file: String,
    pub line: usize,
    pub column: usize,
    pub function: String,
    pub kind: String,
    pub original: String,
    pub replacement: String,
}

/// Where the switch stands.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// Around an expression.
    Expression,
    /// Around a statement.
    Statement,
    /// At the beginning of a function.
    Entry,
    /// Behind a pattern that has no guard.
    Guard,
}

pub struct Found {
    pub fault: Fault,
    pub range: Range<usize>,
    pub place: Place,
    /// What is executed while the switch is on.
    pub text: String,
}

/// Methods that take a closure of type `bool`.
const ASKING: [&str; 20] = [
    "any",
    "all",
    "filter",
    "find",
    "position",
    "rposition",
    "take_while",
    "skip_while",
    "retain",
    "partition",
    "is_some_and",
    "is_none_or",
    "is_ok_and",
    "is_err_and",
    "partition_point",
    "find_any",
    "find_first",
    "position_any",
    "map_or",
    "take_any_while",
];

const SWAPPED: [(&str, &str); 7] = [
    ("any", "all"),
    ("min", "max"),
    ("is_some", "is_none"),
    ("is_ok", "is_err"),
    ("min_by_key", "max_by_key"),
    ("is_some_and", "is_none_or"),
    ("min_by", "max_by"),
];

pub fn faults(file: &str, source: &str) -> Vec<Found> {
    let tree = syn::parse_file(source).unwrap_or_else(|error| panic!("{file}: {error}"));
    let mut finder = Finder { file, source, within: Vec::new(), made: HashSet::new(), found: Vec::new() };
    finder.visit_file(&tree);
    finder.found
}

struct Finder<'s> {
    file: &'s str,
    source: &'s str,
    /// Names of the types and functions that are gone through.
    within: Vec<String>,
    made: HashSet<(usize, usize, String)>,
    found: Vec<Found>,
}

impl Finder<'_> {
    fn text(&self, node: &impl Spanned) -> &str {
        &self.source[node.span().byte_range()]
    }

    fn put(&mut self, place: Place, range: Range<usize>, kind: &str, replacement: String) {
        if !self.made.insert((range.start, range.end, replacement.clone())) {
            return;
        }
        let before = &self.source[..range.start];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let short =
            |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(90).collect::<String>();
        let fault = Fault {
            number: 0,
            file: self.file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: self.source[line_start..range.start].chars().count() + 1,
            function: self.within.join("::"),
            kind: kind.to_owned(),
            original: short(&self.source[range.clone()]),
            replacement: short(&replacement),
        };
        self.found.push(Found { fault, range, place, text: replacement });
    }

    fn always(&mut self, node: &Expr, kind: &str, values: &[bool]) {
        for value in values {
            self.put(Place::Expression, node.span().byte_range(), kind, value.to_string());
        }
    }

    fn function(&mut self, attributes: &[Attribute], signature: &Signature, block: &Block) {
        if is_test(attributes) || signature.constness.is_some() {
            return;
        }
        self.within.push(signature.ident.to_string());
        if !block.stmts.is_empty() && signature.ident != "default" {
            let start = block.brace_token.span.open().byte_range().end;
            for value in defaults::of_return(&signature.output) {
                self.put(Place::Entry, start..start, "function body", format!("return {value};"));
            }
        }
        self.visit_block(block);
        self.within.pop();
    }

    fn condition(&mut self, node: &Expr) {
        if !binds(node) {
            self.always(node, "condition", &[true, false]);
        }
    }

    /// Operands of a chain of one operator; what the whole chain becomes when one of them decides it is one fault.
    fn operands(&mut self, node: &Expr, and: bool) {
        match node {
            Expr::Binary(binary) if is_logical(&binary.op) == Some(and) => {
                self.operands(&binary.left, and);
                self.operands(&binary.right, and);
            }
            Expr::Let(_) => {}
            operand => self.always(operand, "operand", &[and]),
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.function(&item.attrs, &item.sig, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.attrs, &item.sig, block);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if !is_test(&item.attrs) {
            let name = self.text(&item.self_ty).to_owned();
            self.within.push(name);
            visit::visit_item_impl(self, item);
            self.within.pop();
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_variant(&mut self, _: &'ast syn::Variant) {}
    fn visit_attribute(&mut self, _: &'ast Attribute) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_path(&mut self, _: &'ast syn::Path) {}
    fn visit_pat(&mut self, _: &'ast Pat) {}
    fn visit_macro(&mut self, _: &'ast syn::Macro) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}
    fn visit_generics(&mut self, _: &'ast syn::Generics) {}
    fn visit_angle_bracketed_generic_arguments(&mut self, _: &'ast syn::AngleBracketedGenericArguments) {}

    fn visit_expr_repeat(&mut self, node: &'ast syn::ExprRepeat) {
        self.visit_expr(&node.expr);
    }

    fn visit_expr_if(&mut self, node: &'ast syn::ExprIf) {
        self.condition(&node.cond);
        visit::visit_expr_if(self, node);
    }

    fn visit_expr_while(&mut self, node: &'ast syn::ExprWhile) {
        self.condition(&node.cond);
        visit::visit_expr_while(self, node);
    }

    fn visit_expr_binary(&mut self, node: &'ast syn::ExprBinary) {
        let range = node.span().byte_range();
        let (left, right) = (self.text(&node.left).to_owned(), self.text(&node.right).to_owned());
        let binds = binds(&node.left) || binds(&node.right);
        if let Some(and) = is_logical(&node.op) {
            let whole = Expr::Binary(node.clone());
            if binds {
                self.operands(&node.left, true);
                self.operands(&node.right, true);
                if let Some(last) = last_operand(node) {
                    self.always(last, "operand", &[false]);
                }
            } else {
                self.operands(&whole, and);
                self.always(&whole, "operand", &[!and]);
                // A shorter chain that is decided decides the whole one.
                if is_chain(&node.left, and) {
                    self.made.insert(key(&node.left, !and));
                }
                if is_chain(&node.right, and) {
                    self.made.insert(key(&node.right, !and));
                }
            }
        }
        if !binds {
            for other in others(&node.op) {
                let text = match is_assigning(&node.op) {
                    true => format!("{left} {other} {right}"),
                    false => format!("({left}) {other} ({right})"),
                };
                self.put(Place::Expression, range.clone(), "operator", text);
            }
        }
        visit::visit_expr_binary(self, node);
    }

    fn visit_expr_unary(&mut self, node: &'ast syn::ExprUnary) {
        if matches!(node.op, UnOp::Not(_) | UnOp::Neg(_)) {
            let text = self.text(&node.expr).to_owned();
            self.put(Place::Expression, node.span().byte_range(), "unary", text);
        }
        visit::visit_expr_unary(self, node);
    }

    fn visit_expr_match(&mut self, node: &'ast syn::ExprMatch) {
        let open = |arm: &syn::Arm| match &arm.pat {
            Pat::Wild(_) => arm.guard.is_none(),
            // A name, and not a constant or a variant.
            Pat::Ident(name) => arm.guard.is_none() && name.ident.to_string().starts_with(char::is_lowercase),
            _ => false,
        };
        let has_rest = node.arms.last().is_some_and(open);
        for (i, arm) in node.arms.iter().enumerate() {
            if let Some((_, guard)) = &arm.guard {
                self.always(guard, "guard", &[true, false]);
            } else if has_rest && i + 1 < node.arms.len() {
                let end = arm.pat.span().byte_range().end;
                self.put(Place::Guard, end..end, "arm", format!("{} never", self.text(&arm.pat)));
            }
        }
        visit::visit_expr_match(self, node);
    }

    fn visit_expr_method_call(&mut self, node: &'ast syn::ExprMethodCall) {
        let name = node.method.to_string();
        if ASKING.contains(&name.as_str()) {
            for argument in &node.args {
                if let Expr::Closure(closure) = argument
                    && matches!(closure.output, syn::ReturnType::Default)
                {
                    self.always(&closure.body, "closure", &[true, false]);
                }
            }
        }
        let other = SWAPPED.iter().find_map(|&(one, other)| match name.as_str() {
            name if name == one => Some(other),
            name if name == other => Some(one),
            _ => None,
        });
        if let Some(other) = other {
            let (range, method) = (node.span().byte_range(), node.method.span().byte_range());
            let text =
                format!("{}{other}{}", &self.source[range.start..method.start], &self.source[method.end..range.end]);
            self.put(Place::Expression, range, "method", text);
        }
        visit::visit_expr_method_call(self, node);
    }

    fn visit_stmt(&mut self, node: &'ast Stmt) {
        if let Stmt::Expr(expression, Some(_)) = node
            && is_effect(expression)
        {
            self.put(Place::Statement, node.span().byte_range(), "statement", String::new());
        }
        visit::visit_stmt(self, node);
    }
}

fn key(node: &Expr, value: bool) -> (usize, usize, String) {
    let range = node.span().byte_range();
    (range.start, range.end, value.to_string())
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        meta => meta.path().is_ident("test"),
    })
}

fn is_logical(operator: &BinOp) -> Option<bool> {
    match operator {
        BinOp::And(_) => Some(true),
        BinOp::Or(_) => Some(false),
        _ => None,
    }
}

fn is_chain(node: &Expr, and: bool) -> bool {
    matches!(node, Expr::Binary(binary) if is_logical(&binary.op) == Some(and))
}

fn binds(node: &Expr) -> bool {
    match node {
        Expr::Let(_) => true,
        Expr::Binary(binary) => is_logical(&binary.op) == Some(true) && (binds(&binary.left) || binds(&binary.right)),
        _ => false,
    }
}

/// The last operand of a chain that does not bind.
fn last_operand(node: &syn::ExprBinary) -> Option<&Expr> {
    fn deeper(side: &Expr) -> Option<&Expr> {
        match side {
            Expr::Let(_) => None,
            Expr::Binary(inner) if binds(side) => last_operand(inner),
            operand => Some(operand),
        }
    }
    deeper(&node.right).or_else(|| deeper(&node.left))
}

fn is_effect(node: &Expr) -> bool {
    match node {
        Expr::Call(_) | Expr::MethodCall(_) | Expr::Assign(_) => true,
        Expr::Binary(binary) => is_assigning(&binary.op),
        Expr::Try(tried) => is_effect(&tried.expr),
        _ => false,
    }
}

fn is_assigning(operator: &BinOp) -> bool {
    others(operator).first().is_some_and(|other| other.ends_with('=') && !matches!(*other, "==" | "!=" | "<=" | ">="))
}

fn others(operator: &BinOp) -> &'static [&'static str] {
    match operator {
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::Lt(_) => &["==", ">", "<="],
        BinOp::Gt(_) => &["==", "<", ">="],
        BinOp::Le(_) => &[">", "<"],
        BinOp::Ge(_) => &["<", ">"],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::Add(_) => &["-", "*"],
        BinOp::Sub(_) => &["+", "/"],
        BinOp::Mul(_) => &["+", "/"],
        BinOp::Div(_) => &["%", "*"],
        BinOp::Rem(_) => &["/", "+"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::BitAnd(_) => &["|", "^"],
        BinOp::BitOr(_) => &["&", "^"],
        BinOp::BitXor(_) => &["|", "&"],
        BinOp::AddAssign(_) => &["-=", "*="],
        BinOp::SubAssign(_) => &["+=", "/="],
        BinOp::MulAssign(_) => &["+=", "/="],
        BinOp::DivAssign(_) => &["%=", "*="],
        BinOp::RemAssign(_) => &["/=", "+="],
        BinOp::ShlAssign(_) => &[">>="],
        BinOp::ShrAssign(_) => &["<<="],
        BinOp::BitAndAssign(_) => &["|=", "^="],
        BinOp::BitOrAssign(_) => &["&=", "^="],
        BinOp::BitXorAssign(_) => &["|=", "&="],
        _ => &[],
    }
}
