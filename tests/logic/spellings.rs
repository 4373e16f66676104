//! One language of expressions: every spelling of an operator, in every place where expressions stand, has the value that
//! IEC 61131-3 gives it; sentences and short forms in the spellings of other tools are the formulas they stand for.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::sync::LazyLock;

use petril::logic::{
    Body, Bound, Formula, Term, View, bind, parse_fairness, parse_formula, parse_requirement, parse_requirements,
};
use petril::sif::{Kind, Specification};
use petril::source::Source;
use petril::translate::System;
use proptest::prelude::*;
use support::process::petril;
use support::systems::system;

/// A program whose variables have the names of operators, too.
static SYSTEM: LazyLock<System> = LazyLock::new(|| {
    let text = "PROGRAM p VAR_INPUT a, b, c, and, not, G, X : BOOL; i : INT; END_VAR VAR_OUTPUT q : BOOL; END_VAR\n\
                VAR r : ARRAY [0..2] OF INT; END_VAR\nLD a\nST q\nEND_PROGRAM";
    system(text, &[])
});

/// A formula about a, b and c, evaluated.
fn value(formula: &Bound, values: [bool; 3]) -> bool {
    let of = |f: &Bound| value(f, values);
    match formula {
        Bound::Truth(truth) => *truth,
        Bound::Variable(id) => {
            let name = &SYSTEM.program.variable(*id).name;
            values[["a", "b", "c"].iter().position(|known| known == name).unwrap()]
        }
        Bound::Not(f) => !of(f),
        Bound::And(f, g) => of(f) && of(g),
        Bound::Or(f, g) => of(f) || of(g),
        Bound::Implies(f, g) => !of(f) || of(g),
        Bound::Iff(f, g) => of(f) == of(g),
        Bound::Compare(comparison, left, right) => comparison.holds(number(left, values), number(right, values)),
        other => panic!("{other:?}"),
    }
}

fn number(term: &Term, values: [bool; 3]) -> i128 {
    match term {
        Term::Number(number) => *number,
        Term::Truth(f) => i128::from(value(f, values)),
        Term::Sum(left, right) => number(left, values) + number(right, values),
        other => panic!("{other:?}"),
    }
}

/// The values for all values of a, b and c.
fn table(value: impl Fn([bool; 3]) -> bool) -> Vec<bool> {
    (0..8).map(|n| value([n & 1 != 0, n & 2 != 0, n & 4 != 0])).collect()
}

/// The formula a text becomes in each place where one can stand, in requirements and beside them.
fn everywhere(text: &str) -> Vec<(&'static str, Formula)> {
    let said = |what: &str, text: &str| {
        let (file, diagnostics) = parse_requirements(&Source::new("r.req", text));
        assert!(diagnostics.is_empty(), "{what} {text}: {diagnostics:?}");
        file
    };
    let of = |body: Body| match body {
        Body::Formula(formula) => formula,
        other => panic!("{other:?}"),
    };
    let required = said("requirement", &format!("requirement r: {text};")).requirements.remove(0);
    assert!(parse_fairness(&Source::new("f", format!("again and again {text}"))).is_ok(), "{text}");
    said("fair", &format!("fair: again and again {text};"));
    vec![
        ("--until", parse_formula(&Source::new("f", text)).unwrap_or_else(|e| panic!("{text}: {e:?}"))),
        ("-r", of(parse_requirement("r", &Source::new("f", text)).unwrap_or_else(|e| panic!("{text}: {e:?}")).body)),
        ("requirement", of(required.body)),
        ("assume", said("assume", &format!("assume x \"y\": {text};")).assumptions.remove(0).formula),
        ("assert", said("assert", &format!("assert {text};")).assertions.remove(0).formula),
    ]
}

/// The formula of a safety function, evaluated on a, b and c.
fn in_sif(text: &str) -> Vec<bool> {
    let file = format!(
        "function T {{ interface {{ input a; input b; input c; output F; }} formal {{ F = {text}; U = a & b & c; }} }}"
    );
    let (specification, diagnostics) = Specification::read(&[Source::new("x.sif", file)]);
    let specification = specification.unwrap_or_else(|| panic!("{text}: {diagnostics:?}"));
    let signal = specification.signals.iter().find(|signal| signal.name == "F").unwrap();
    let Kind::Defined { formula, .. } = &signal.kind else { panic!("{signal:?}") };
    let name = |values: [bool; 3], name: &str| values[["a", "b", "c"].iter().position(|known| *known == name).unwrap()];
    table(|values| formula.holds(|id| name(values, &specification.signal(id).name)))
}

/// What IEC 61131-3 says of an expression, and what is left of it: by hand.
#[test]
fn every_spelling_has_its_value_everywhere() {
    type Value = fn(bool, bool, bool) -> bool;
    let cases: [(&[&str], Value); 17] = [
        (&["a & b", "a && b", "a AND b", "a and b", "a And b", "a ∧ b", "(a)AND(b)"], |a, b, _| a && b),
        (&["a | b", "a || b", "a OR b", "a or b", "a ∨ b"], |a, b, _| a || b),
        (&["a XOR b", "a xor b", "a ⊕ b", "a <> b", "a != b", "a ≠ b"], |a, b, _| a != b),
        (&["!a", "NOT a", "not a", "NOT(a)", "¬a", "~a", "NOT NOT !a"], |a, _, _| !a),
        (
            &["a -> b", "a => b", "a ==> b", "a → b", "a ⇒ b", "a implies b", "a IMPLIES b", "(a --> b)"],
            |a, b, _| !a || b,
        ),
        (&["a <-> b", "a <=> b", "a = b", "a == b", "a ↔ b", "a ⇔ b", "a iff b"], |a, b, _| a == b),
        (&["a = TRUE", "a == true", "a <> FALSE"], |a, _, _| a),
        (&["a | b & c", "a OR b AND c", "a || b && c"], |a, b, c| a || b && c),
        (&["a & b | c", "a AND b OR c"], |a, b, c| a && b || c),
        (&["a XOR b AND c", "a xor b & c"], |a, b, c| a != (b && c)),
        (&["a OR b XOR c", "a | b xor c"], |a, b, c| a || b != c),
        (&["NOT a = b", "!a == b"], |a, b, _| a != b),
        (&["a AND b = c", "a & b == c"], |a, b, c| a && b == c),
        (&["a -> b -> c", "a => b => c"], |a, b, c| !a || !b || c),
        (&["a OR b -> c", "a || b => c"], |a, b, c| !(a || b) || c),
        (&["exactly one of (a, b, c)"], |a, b, c| u8::from(a) + u8::from(b) + u8::from(c) == 1),
        (&["at most one of (a & b, c)"], |a, b, c| !(a && b && c)),
    ];
    for (texts, expected) in cases {
        for text in texts {
            let expected = table(|[a, b, c]| expected(a, b, c));
            for (place, formula) in everywhere(text) {
                let bound = bind(&formula, &SYSTEM, View::Scan).unwrap_or_else(|e| panic!("{text}: {e:?}"));
                assert_eq!(table(|values| value(&bound, values)), expected, "{text} in {place}");
            }
            assert_eq!(in_sif(text), expected, "{text} in a safety function");
        }
    }
}

/// An expression of a test's own.
#[derive(Clone, Debug)]
enum Tree {
    Leaf(usize),
    Not(Box<Tree>),
    /// Operator by its priority, weakest first, and which of its spellings.
    Two(usize, usize, Box<Tree>, Box<Tree>),
}

const SPELLINGS: [&[&str]; 7] = [
    &["<->", "<=>", "iff", "IFF"],
    &["->", "=>", "-->", "implies"],
    &["|", "||", "OR", "or"],
    &["XOR", "xor", "⊕"],
    &["&", "&&", "AND", "and"],
    &["=", "=="],
    &["<>", "!="],
];

impl Tree {
    fn value(&self, values: [bool; 3]) -> bool {
        match self {
            Self::Leaf(leaf) => *values.get(*leaf).unwrap_or(&(*leaf == 3)),
            Self::Not(tree) => !tree.value(values),
            Self::Two(operator, _, left, right) => {
                let (left, right) = (left.value(values), right.value(values));
                match operator {
                    0 | 5 => left == right,
                    1 => !left || right,
                    2 => left || right,
                    4 => left && right,
                    _ => left != right,
                }
            }
        }
    }

    /// The text with no more parentheses than the priorities ask for.
    fn text(&self) -> String {
        self.set(0)
    }

    fn set(&self, around: usize) -> String {
        match self {
            Self::Leaf(leaf) => ["a", "b", "c", "TRUE", "FALSE"][*leaf].to_owned(),
            Self::Not(tree) => format!("{} {}", if around.is_multiple_of(2) { "NOT" } else { "!" }, tree.set(8)),
            Self::Two(operator, spelling, left, right) => {
                let (operator, signs) = (*operator, SPELLINGS[*operator]);
                let strength = operator.min(5) + 1;
                let (left, right) = match operator {
                    // To the right.
                    1 => (left.set(strength + 1), right.set(strength)),
                    // Not in a row.
                    5 | 6 => (left.set(strength + 1), right.set(strength + 1)),
                    _ => (left.set(strength), right.set(strength + 1)),
                };
                let text = format!("{left} {} {right}", signs[spelling % signs.len()]);
                if strength < around { format!("({text})") } else { text }
            }
        }
    }
}

fn tree() -> impl Strategy<Value = Tree> {
    (0_usize..5).prop_map(Tree::Leaf).prop_recursive(5, 24, 2, |inner| {
        prop_oneof![
            1 => inner.clone().prop_map(|tree| Tree::Not(Box::new(tree))),
            4 => (0_usize..7, 0_usize..4, inner.clone(), inner)
                .prop_map(|(operator, spelling, f, g)| Tree::Two(operator, spelling, Box::new(f), Box::new(g))),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn random_expressions_have_their_value(tree in tree()) {
        let text = tree.text();
        let expected = table(|values| tree.value(values));
        let formula = parse_formula(&Source::new("f", text.as_str())).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        let bound = bind(&formula, &SYSTEM, View::Scan).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        prop_assert_eq!(table(|values| value(&bound, values)), expected.clone(), "{}", text);
        prop_assert_eq!(in_sif(&text), expected, "{}", text);
        // And what is printed of it is read again.
        let printed = bound.text(&*SYSTEM);
        prop_assert_eq!(support::formula(&printed, &SYSTEM, View::Scan), bound, "{}", printed);
    }
}

/// The requirement a text becomes, as it would be printed.
fn required(text: &str) -> Result<String, String> {
    let requirement =
        parse_requirement("r", &Source::new("f", text)).map_err(|e| format!("{}; {}", e.message, e.help.join("; ")))?;
    match requirement.body {
        Body::Formula(formula) => bind(&formula, &SYSTEM, View::Scan)
            .map(|bound| bound.text(&*SYSTEM))
            .map_err(|errors| errors.into_iter().map(|e| e.message).collect::<Vec<_>>().join("; ")),
        other => panic!("{other:?}"),
    }
}

#[test]
fn requirements_of_other_tools_are_read() {
    let same = "at the end of the same cycle.";
    let cases = [
        // PLCverif: braces, quotes, `instance`, words of truth.
        (format!("If {{instance.a = TRUE AND instance.b = FALSE}} is true at the end of the PLC cycle, then {{c}} should always be true {same}"), "AG (a = TRUE & b = FALSE -> c)"),
        (format!("If 'a' is true at the end of the PLC cycle, then 'b' should always be false {same}"), "AG (a -> !b)"),
        (format!("If {{a}} is false at the end of the PLC cycle, then {{b}} and {{c}} should also be true {same}"), "AG (!a -> b & c)"),
        (format!("If {{a}} is true at the beginning of the PLC cycle, then {{b}} {same}"), "AG (pre(a) -> b)"),
        ("{instance.i = 0 --> a} is always true at the end of the PLC cycle.".to_owned(), "AG (i = 0 -> a)"),
        ("{a} is impossible at the end of the PLC cycle.".to_owned(), "AG !a"),
        ("{a OR b} should always be false at the end of the PLC cycle.".to_owned(), "AG !(a | b)"),
        ("a is never true at the end of a scan.".to_owned(), "AG !a"),
        ("`a` is true at the end of every scan.".to_owned(), "AG a"),
        ("`a` is true at the end of no scan.".to_owned(), "AG !a"),
        ("If {a} is true at the end of cycle N and {b} is true at the end of cycle N+1, then {c} is always true at the end of cycle N+1.".to_owned(), "AG (a -> AX (b -> c))"),
        ("At most one of a, b and c is true at the end of a cycle.".to_owned(), "AG (a + b + c <= 1)"),
        ("pattern-implication(instance.a, instance.r[1] <> 2)".to_owned(), "AG (a -> r[1] != 2)"),
        ("pattern_forbidden(p.a)".to_owned(), "AG !a"),
        // LTL without its name.
        ("G a".to_owned(), "AG a"),
        ("G (a => b)".to_owned(), "AG (a -> b)"),
        ("F a".to_owned(), "AF a"),
        ("X a".to_owned(), "AX a"),
        ("a U b".to_owned(), "A [a U b]"),
        ("a W b".to_owned(), "A [a W b]"),
        ("G (a -> F b)".to_owned(), "LTL G (a -> F b)"),
        ("G F a -> G F b".to_owned(), "LTL G F a -> G F b"),
        ("G & X".to_owned(), "G & X"),
        ("G AND X or not and and".to_owned(), "G & X | not & and"),
        // Words.
        ("always (a -> b)".to_owned(), "AG (a -> b)"),
        ("always a -> b".to_owned(), "AG (a -> b)"),
        ("never(a AND b)".to_owned(), "AG !(a & b)"),
        ("NEVER a && b".to_owned(), "AG !(a & b)"),
        ("AG NOT a".to_owned(), "AG !a"),
        ("AG {a AND {b}}".to_owned(), "AG (a & b)"),
    ];
    for (text, expected) in cases {
        assert_eq!(required(&text).as_deref(), Ok(expected), "{text}");
    }
}

/// What has two readings has none.
#[test]
fn what_is_doubtful_is_refused() {
    let cases = [
        ("AG a = b = c", "two comparisons follow each other"),
        ("AG (i = 1 = a)", "two comparisons follow each other"),
        ("AG (0 < i < 5)", "two comparisons follow each other"),
        ("LTL G (a = b = c)", "two comparisons follow each other"),
        ("a --> b", "`-->` is an implication in PLCverif and \"leads to\" in UPPAAL"),
        ("AG (i / 2 = 1)", "there is no operator `/` in formulas"),
        ("AG (i MOD 2 = 1)", "there is no operator `MOD` in formulas"),
        ("{1} is always true at the end of the PLC cycle.", "`{1}` is a place of a pattern"),
        ("G a & b", "one side of this is about the first scan only"),
        ("a -> F b", "one side of this is about the first scan only"),
        ("AG (a -> F b)", "a formula of LTL is about one path"),
        ("always (a) & b", "`always` speaks of all that follows"),
        ("If {a} is true at the end of the PLC cycle, then {b} should always be true.", "cannot stand here"),
        ("AG (i >= 20.5)", "`20.5` is a real number, and formulas have none"),
        ("instance.z", "the program `p` has no variable `instance.z`"),
        ("at most one of (a, b and c)", "expected"),
    ];
    for (text, expected) in cases {
        let said = required(text).unwrap_err();
        assert!(said.contains(expected), "{text}: {said}");
    }
    let file = "function T { interface { input a; input b; input c; output F; } formal { F = a = b = c; } }";
    let (_, diagnostics) = Specification::read(&[Source::new("x.sif", file)]);
    assert_eq!(diagnostics[0][0].message, "two comparisons follow each other");
}

/// Properties in JSON are patterns with parameters; a description that says something else is told.
#[test]
fn properties_of_plcverif_are_requirements() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("p.il", "PROGRAM p VAR_INPUT a : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM");
    let pattern = |id: &str, parameters: &str, described: &str| {
        format!(
            "{{\"property_description\": \"says\", \"property\": {{\"job_req\": \"pattern\", \"pattern_id\": \"pattern-{id}\", \
                 \"pattern_params\": {parameters}, \"pattern_description\": \"{described}\"}}}}"
        )
    };
    let same = "true at the end of the PLC cycle, then {1} should always be true at the end of the same cycle.";
    let list = [
        pattern("implication", "{\"0\": \"instance.a = TRUE\", \"1\": \"instance.q\"}", &format!("If {{0}} is {same}")),
        pattern("forbidden", "{\"1\": \"instance.a AND NOT instance.q\"}", "no sentence at all"),
        "{\"property\": {\"job_req\": \"assertion\"}}".to_owned(),
        pattern("invariant", "{\"1\": \"q OR NOT a\"}", "{1} is impossible at the end of the PLC cycle."),
    ];
    write("p.json", &format!("{{\"id\": \"task\", \"properties_to_be_validated\": [{}]}}", list.join(", ")));
    let run = petril(folder.path(), &["check", "p.il", "--require", "p.json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    for line in ["HOLDS    task.1: says", "HOLDS    task.2: says", "HOLDS    task.4: says", "3 requirements: 3 hold"] {
        assert!(run.stdout.contains(line), "{line}\n{}", run.stdout);
    }
    assert_eq!(run.stderr.matches("warning[W0514]").count(), 2, "{}", run.stderr);
    assert!(run.stderr.contains("p.json, property 3") && run.stderr.contains("p.json, property 4"), "{}", run.stderr);
    for broken in ["{", "[]x", "{\"property\": 3}"] {
        write("b.json", broken);
        let run = petril(folder.path(), &["check", "p.il", "--require", "b.json"]);
        assert_eq!(run.code, 2, "{broken}");
        assert!(run.stderr.contains("b.json"), "{}", run.stderr);
    }
}
