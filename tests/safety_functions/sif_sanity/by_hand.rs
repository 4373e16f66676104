//! Each kind of finding, by hand.

use petril::sif::sanity::{Doubt, check, counts, never};

use super::{read, said};

const F1: &str = include_str!("../../../examples/beam-interlock.sif");

#[test]
fn the_seed_papers_function() {
    let specification = read(F1);
    let counts = &counts(&specification, 0, &never())[0];
    assert_eq!((counts.inputs, counts.triggers.as_deref(), counts.left.as_deref()), (7, Some("43"), Some("10")));
    let step = |name: &str, alone: &str, left: &str| (name.to_owned(), Some(alone.to_owned()), Some(left.to_owned()));
    let name = |at: usize| specification.restrictions[at].name.clone();
    let steps: Vec<_> = counts
        .excluded
        .iter()
        .map(|step| (name(step.restriction), step.by_itself.clone(), step.left.clone()))
        .collect();
    assert_eq!(steps, [step("R3", "24", "19"), step("R1", "6", "13"), step("R2", "11", "10")]);
    // Nothing is wrong with it.
    assert_eq!(said(F1), Vec::<String>::new());
}

/// One function with these inputs, formulas and restrictions.
fn function(inputs: &str, formal: &str) -> String {
    let inputs: String = inputs.split(' ').map(|name| format!("input {name}; ")).collect();
    format!("function F {{ interface {{ {inputs}output f; }} formal {{ {formal} }} }}")
}

#[test]
fn inputs() {
    assert_eq!(said(&function("a b", "f = a;")), ["W0920 no equation uses the input `b`"]);
    assert_eq!(
        said(&function("a b c", "f = c | (a & b) | (a & !b);")),
        ["W0921 the input `b` makes no difference to any output"]
    );
    assert_eq!(
        said(&function("a b c", "f = a | (b & c); restriction R: always c -> a;")),
        ["W0921 the input `b` makes no difference to any output under the restriction `R`"]
    );
    // Of inputs that depend on each other, each has its effect.
    assert_eq!(
        said(&function("a b c", "f = a; restriction R: exactly one of a, b, c;"))[0],
        "W0920 no equation uses the input `b`"
    );
    let two = format!(
        "{}\nfunction G {{ interface {{ input a; input b; output g; }} formal {{ g = !a & c; }} }}",
        function("a b c", "f = a & b & c;")
    );
    assert_eq!(
        said(&two),
        ["W0922 function `G` lists `b` and does not use it", "W0923 function `G` uses `c` and does not list it"]
    );
}

#[test]
fn outputs() {
    assert_eq!(said(&function("a", "f = a | !a;")), ["W0924 `f` is always TRUE"]);
    // Of three restrictions only two are needed.
    let text = function(
        "a b c",
        "f = a & c; restriction R: always a -> b; restriction S: never b & c; restriction T: never a & b & !c;",
    );
    assert!(
        said(&text).contains(&"W0924 `f` is always FALSE under the restrictions `R` and `S`".to_owned()),
        "{:?}",
        said(&text)
    );
    let two = |g: &str| {
        format!("{}\nfunction G {{ interface {{ output g; }} formal {{ g = {g}; }} }}", function("a b", "f = a & b;"))
    };
    assert_eq!(said(&two("!(!b | !a)")), ["W0930 `f` and `g` are always the same"]);
    assert_eq!(said(&two("!f")), ["W0930 `f` and `g` are always opposites"]);
    assert_eq!(
        said(&(two("a") + "restriction R: always a -> b;")).last().unwrap(),
        "W0930 `f` and `g` are always the same under the restriction `R`"
    );
}

#[test]
fn what_is_remembered_is_not_constant() {
    // `g` is TRUE while `f` is still latched and `a` gone.
    let text = "function F { interface { input a; input r; output f latched until r; } formal { f = a; } }
        function G { interface { input a; input f; output g; } formal { g = f & !a; } }";
    assert_eq!(said(text), Vec::<String>::new());
    let plain = text.replace("latched until r", "");
    assert_eq!(said(&plain), ["W0920 no equation uses the input `r`", "W0924 `g` is always FALSE"]);
    // And while it is delayed, the other way round.
    let delayed =
        plain.replace("output f", "output f delayed T#1s").replace("f & !a", "a & !f").replace("input r;", "");
    assert_eq!(said(&delayed), Vec::<String>::new());
}

#[test]
fn resets() {
    let latched = |reset: &str, more: &str| {
        format!(
            "function F {{ interface {{ input a; input b; output f latched until {reset}; }} formal {{ f = a & b; {more} }} }}"
        )
    };
    assert_eq!(said(&latched("!a", "")), Vec::<String>::new());
    // What sets is stronger.
    assert_eq!(said(&latched("a & b", "")), ["W0931 `f` is never reset"]);
    assert_eq!(
        said(&latched("!a & b", "restriction R: always b -> a;"))[0],
        "W0931 `f` is never reset under the restriction `R`"
    );
}

#[test]
fn restrictions() {
    let text =
        function("a b", "f = a | b; restriction R: never a; restriction S: always a & b; restriction T: never !b;");
    assert_eq!(said(&text), ["W0925 the restrictions `R` and `S` contradict each other: `F` has no test"]);
    let text = "restriction R: always a; restriction S: never a & b; restriction T: always b;".to_owned()
        + &function("a b", "f = TRUE;");
    assert_eq!(said(&text), ["W0925 the restrictions `R`, `S` and `T` contradict each other"]);
    assert_eq!(
        said(&function("a b", "f = a; restriction R: never b & !b; restriction S: never a & b & f;"))[..2],
        ["W0920 no equation uses the input `b`", "W0926 the restriction `R` excludes nothing"]
    );
    assert_eq!(
        said(&function(
            "a b c",
            "f = a & !b | c; restriction R: always a -> b; restriction S: always b -> c; restriction T: always a -> c;"
        ))
        .iter()
        .filter(|said| said.starts_with("W0926"))
        .collect::<Vec<_>>(),
        ["W0926 the restriction `T` excludes nothing that `R` and `S` together do not"]
    );
    let apart = "input x; input y; input z; restriction R: never x & y; restriction S: never z & a;".to_owned()
        + &function("a", "f = a;");
    let apart: Vec<String> = said(&apart).into_iter().filter(|said| said.starts_with("W0927")).collect();
    assert_eq!(apart, ["W0927 the restriction `R` has nothing to do with any function"]);
}

#[test]
fn causes_and_literals() {
    let text = function("a b c d", "f = (a & b) | (c & d); restriction R: never a & b;");
    assert_eq!(said(&text), ["W0928 no test is left in which `a & b` makes `f` TRUE under the restriction `R`"]);
    // In an auxiliary value, and in a part of a conjunction: `a` is TRUE in a test, but does not make `f` TRUE.
    let text = function("a b c d", "f = (T & d) | c; T = a | b; restriction R: never a & d;");
    assert_eq!(said(&text), ["W0928 no test is left in which `a & d` makes `f` TRUE under the restriction `R`"]);
    let text = function("a b c", "f = !(a & !b) & !c; restriction R: always a;");
    assert_eq!(said(&text)[0], "W0928 no test is left in which `!a` makes `f` TRUE under the restriction `R`");
    // Where `c` is TRUE, so is `a`. The other `b` decides.
    let text = function("a b c d", "f = a | (b & c) | (b & d); restriction R: always c -> a;");
    assert_eq!(said(&text), ["W0929 the 1st `b` of `f` never decides under the restriction `R`"]);
}

#[test]
fn an_end_is_put_to_what_takes_long() {
    let specification = read(F1);
    let stop: petril::sif::Stop = std::sync::Arc::new(|| true);
    let findings = check(&specification, &stop);
    assert!(!findings.is_empty());
    assert!(findings.iter().all(|finding| finding.doubt == Doubt::NotDecided), "{findings:?}");
    let counts = &counts(&specification, 0, &stop)[0];
    assert_eq!((counts.inputs, &counts.triggers, &counts.left), (7, &None, &None));
}
