//! Tests of the priorities of operators and of errors.

use super::*;
use crate::ltl::Path;

/// Formula with all parentheses.
fn explicit(formula: &Formula) -> String {
    let two = |f: &Formula, sign: &str, g: &Formula| format!("({} {sign} {})", explicit(f), explicit(g));
    match &formula.expression {
        Expression::Truth(value) => value.to_string(),
        Expression::Number(number) => number.to_string(),
        Expression::Name(name) => name.clone(),
        Expression::AtLine(line) => format!("at {line}"),
        Expression::AtIdle => "at idle".to_owned(),
        Expression::AtEnd => "at End".to_owned(),
        Expression::Deadlock => "at deadlock".to_owned(),
        Expression::FirstScan => "at first scan".to_owned(),
        Expression::InputChanges => "an input changes".to_owned(),
        Expression::OutputChanges => "an output changes".to_owned(),
        Expression::Past(past, of) => {
            format!("{past:?}({})", of.iter().map(explicit).collect::<Vec<_>>().join(", "))
        }
        Expression::Held(f, duration) => format!("held({}, {:?})", explicit(f), duration.amount),
        Expression::Within(f, duration) => format!("({} within {:?})", explicit(f), duration.amount),
        Expression::Response(f, g, duration) => {
            format!("response({}, {}, {:?})", explicit(f), explicit(g), duration.amount)
        }
        Expression::Tokens(name) => format!("#{name}"),
        Expression::Marked(name) => format!("<{name}>"),
        Expression::Enabled(name) => format!("<<{name}>>"),
        Expression::Not(f) => format!("!{}", explicit(f)),
        Expression::And(f, g) => two(f, "&", g),
        Expression::Or(f, g) => two(f, "|", g),
        Expression::Implies(f, g) => two(f, "->", g),
        Expression::Iff(f, g) => two(f, "<->", g),
        Expression::Compare(comparison, f, g) => two(f, &format!("{comparison:?}"), g),
        Expression::Sum(f, g) => two(f, "+", g),
        Expression::Difference(f, g) => two(f, "-", g),
        Expression::Product(f, g) => two(f, "*", g),
        Expression::Temporal(q, t, f) => format!("{q:?} {t:?} {}", explicit(f)),
        Expression::Ltl(path) => format!("LTL {}", explicit_path(path)),
        Expression::Until { quantifier, weak, hold, release } => {
            format!("{quantifier:?}[{} {} {}]", explicit(hold), if *weak { "W" } else { "U" }, explicit(release))
        }
    }
}

#[test]
fn formulas_about_paths_bind_their_operators() {
    assert_eq!(asked("LTL G (a -> F b)"), "LTL G (a implies F b)");
    assert_eq!(asked("LTL a & b -> X c | d"), "LTL ((a & b) implies (X c or d))");
    assert_eq!(asked("LTL a U b & c W d"), "LTL ((a U b) and (c W d))");
    assert_eq!(asked("LTL a U b R c"), "LTL (a U (b R c))");
    assert_eq!(asked("LTL a = 1 U b + c <= 1"), "LTL ((a Equal 1) U ((b + c) AtMost 1))");
    assert_eq!(asked("LTL !a W !G b"), "LTL (!a W not G b)");
    assert_eq!(asked("LTL G !X a <-> F (b)"), "LTL (G not X a iff F b)");
    assert_eq!(asked("LTL (a | b) & !(c U (d))"), "LTL ((a | b) and not (c U d))");
    // Operators are names where no formula follows, and so is `LTL`.
    assert_eq!(asked("LTL X = 1 & G"), "LTL ((X Equal 1) & G)");
    assert_eq!(asked("LTL (X) U F"), "LTL (X U F)");
    assert_eq!(asked("LTL G ((a since b) -> F pre(c))"), "LTL G (Since(a, b) implies F Pre(c))");
    assert_eq!(asked("LTL & a"), "(LTL & a)");
    assert_eq!(asked("LTL a U"), "expected a formula, found the end");
    assert!(asked("LTL G AF a").starts_with("a formula of LTL is about one path"));
    assert_eq!(asked("LTL F a = 1"), "a formula about a path is compared with or counted as a number");
}

/// Formula of a requirement, CTL or LTL, with all parentheses.
fn asked(text: &str) -> String {
    match parse_requirement("r", &Source::new("formula", text)) {
        Ok(Requirement { body: Body::Formula(formula), .. }) => explicit(&formula),
        Ok(other) => format!("{other:?}"),
        Err(error) => error.message,
    }
}

fn explicit_path(path: &Path<Formula>) -> String {
    let one = |sign: &str, f: &Path<Formula>| format!("{sign} {}", explicit_path(f));
    let two = |f: &Path<Formula>, sign: &str, g: &Path<Formula>| {
        format!("({} {sign} {})", explicit_path(f), explicit_path(g))
    };
    match path {
        Path::State(f) => explicit(f),
        Path::Not(f) => one("not", f),
        Path::Next(f) => one("X", f),
        Path::Finally(f) => one("F", f),
        Path::Globally(f) => one("G", f),
        Path::And(f, g) => two(f, "and", g),
        Path::Or(f, g) => two(f, "or", g),
        Path::Implies(f, g) => two(f, "implies", g),
        Path::Iff(f, g) => two(f, "iff", g),
        Path::Until(f, g) => two(f, "U", g),
        Path::WeakUntil(f, g) => two(f, "W", g),
        Path::Release(f, g) => two(f, "R", g),
    }
}

fn read(text: &str) -> String {
    match parse_formula(&Source::new("formula", text)) {
        Ok(formula) => explicit(&formula),
        Err(error) => error.message,
    }
}

#[test]
fn operators_bind_as_the_language_says() {
    let cases = [
        ("a -> b -> c", "(a -> (b -> c))"),
        ("a | b & c", "(a | (b & c))"),
        ("a <-> b -> c", "(a <-> (b -> c))"),
        ("!a & b", "(!a & b)"),
        ("AG a -> b", "(All Globally a -> b)"),
        ("AG EF !a | b", "(All Globally Some Finally !a | b)"),
        ("a + b * 2 = 3 & c", "(((a + (b * 2)) Equal 3) & c)"),
        ("a - b - 1 <= -1", "(((a - b) - 1) AtMost -1)"),
        ("a<-1", "(a Less -1)"),
        ("a <> b", "(a Unequal b)"),
        ("A [a U b | c]", "All[a U (b | c)]"),
        ("E[a W E [b U c]]", "Some[a W Some[b U c]]"),
        ("AX(a)", "All Next a"),
        ("AX & EG = AG", "(AX & (EG Equal AG))"),
        ("AX != EG & AG !a", "((AX Unequal EG) & All Globally !a)"),
        ("A = 1 & E | U", "(((A Equal 1) & E) | U)"),
        ("at line 3 -> at idle | at END", "(at 3 -> (at idle | at End))"),
        ("marked(\"S1=1\") & enabled( \"block\" )", "(<S1=1> & <<block>>)"),
        ("tokens(\"a b\") + 1 < TOKENS ( \"c\" ) | AT DeadLock", "(((#a b + 1) Less #c) | at deadlock)"),
        ("tokens & deadlock = tokens (* no words here *)", "(tokens & (deadlock Equal tokens))"),
        ("true & pump.T.Q (* comment *) // more", "(true & pump.T.Q)"),
    ];
    for (text, expected) in cases {
        assert_eq!(read(text), expected, "{text}");
    }
}

#[test]
fn what_is_no_formula_is_explained() {
    let cases = [
        ("", "expected a formula, found the end"),
        ("a b", "expected the end or an operator, found `b`"),
        ("A [a b]", "expected an operator or `U` or `W`, found `b`"),
        ("a & ", "expected a formula, found the end"),
        ("a = 99999999999999999999", "this number is too large"),
        ("(a", "expected an operator or `)`, found the end"),
        ("A [a U b", "expected an operator or `]`, found the end"),
    ];
    for (text, expected) in cases {
        assert_eq!(read(text), expected, "{text}");
    }
}

#[test]
fn huge_formulas_are_refused_and_large_ones_are_not() {
    let nested = |n: usize| format!("{}a{}", "(".repeat(n), ")".repeat(n));
    assert_eq!(read(&nested(200)), "a");
    for text in
        [nested(100_000), "!".repeat(100_000) + "a", "a & ".repeat(100_000) + "a", "a -> ".repeat(100_000) + "a"]
    {
        assert!(parse_formula(&Source::new("formula", text)).is_err());
    }
    assert!(read(&("a & ".repeat(300) + "a")).starts_with("(((("));
}

#[test]
fn a_file_gives_its_requirements_and_all_its_errors() {
    let text = "// first\nrequirement one \"it says; this\": AG a;\nrequirement two: a &;\nrequire three: b;\n\
                requirement One: (* again *) b;\nrequirement four \"x\" c";
    let (file, diagnostics) = parse_requirements(&Source::new("r.req", text));
    let read: Vec<_> =
        file.requirements.iter().map(|r| (r.name.as_str(), r.sentence.as_deref(), r.text.as_str())).collect();
    assert_eq!(read, [("one", Some("it says; this"), "AG a"), ("One", None, "b")]);
    let source = Source::new("r.req", text);
    let errors: Vec<_> = diagnostics.iter().map(|d| (source.line_of(d.span().start), d.message.as_str())).collect();
    assert_eq!(
        errors,
        [
            (3, "expected a formula, found `;`"),
            (4, "expected `requirement`, found `require`"),
            (5, "there are two requirements named `One`"),
            (6, "expected `:`, found `c`"),
        ]
    );
}
