//! Tests of the reader: formulas as text, and diagnostics of invalid input.

use super::{Property, Query, read};
use crate::net::{Arcs, Builder, Net};
use petril_base::source::Source;
use petril_logic::{Nodes, bind_in_net, parse_formula};

/// A property set around properties, which begin in line 2.
fn set(properties: &str) -> String {
    format!("<?xml version='1.0'?><property-set xmlns='http://mcc.lip6.fr/'>\n{properties}\n</property-set>")
}

/// A property with its formula in line 2 of its set.
fn property(formula: &str) -> String {
    set(&format!("<property><id>f</id><formula>{formula}</formula></property>"))
}

fn properties(text: &str) -> Vec<Property> {
    let (properties, errors) = read(&Source::new("test.xml", text));
    assert!(errors.is_empty(), "{text}\n{errors:#?}");
    properties
}

/// Diagnostics of a text, as `line:column code message`.
fn problems(text: &str) -> Vec<String> {
    let source = Source::new("test.xml", text);
    let (_, errors) = read(&source);
    let line = |d: &petril_base::diagnostic::Diagnostic| {
        let (line, column) = source.line_column(d.span().start);
        format!("{line}:{column} {} {}", d.code, d.message)
    };
    errors.iter().map(line).collect()
}

/// A net with the places p, q and r and the transitions t and u.
fn net() -> Net {
    let mut builder = Builder::new("net");
    let places = ["p", "q", "r"].map(|name| builder.place(name, name == "p"));
    for (name, to) in [("t", 1), ("u", 2)] {
        builder.transition(name, Arcs { consume: &places[..1], produce: &places[to..=to], read: &[] });
    }
    builder.build()
}

/// Text of the formula read from a property.
fn text(formula: &str) -> String {
    let net = net();
    let properties = properties(&property(formula));
    let Query::Holds(read) = &properties[0].query else { panic!("{formula} asks for a bound") };
    let bound = bind_in_net(read, &net.nodes()).unwrap_or_else(|e| panic!("{formula}\n{e:#?}"));
    let text = bound.text(&net);
    let again = parse_formula(&Source::new("formula", text.as_str())).unwrap();
    assert_eq!(bind_in_net(&again, &net.nodes()), Ok(bound), "{text}");
    text
}

const P: &str = "<is-fireable><transition>t</transition></is-fireable>";
const Q: &str = "<is-fireable><transition>u</transition></is-fireable>";

#[test]
fn every_operator_of_truth_is_read() {
    let cases = [
        ("<true/>", "TRUE"),
        ("<false/>", "FALSE"),
        ("<deadlock/>", "at deadlock"),
        ("<negation>P</negation>", "!P"),
        ("<conjunction>PQ</conjunction>", "P & Q"),
        ("<disjunction>PQ</disjunction>", "P | Q"),
        ("<exclusive-disjunction>PQ</exclusive-disjunction>", "!(P <-> Q)"),
        ("<implication>PQ</implication>", "P -> Q"),
        ("<equivalence>PQ</equivalence>", "P <-> Q"),
        ("<conjunction>P</conjunction>", "P"),
        ("<disjunction>PQ<true/></disjunction>", "P | Q | TRUE"),
        ("<conjunction>PQ<true/><false/>P</conjunction>", "P & Q & (TRUE & FALSE) & P"),
        ("<is-fireable><transition> t </transition><transition>u</transition></is-fireable>", "P | Q"),
        ("<exists-path><finally>P</finally></exists-path>", "EF P"),
        ("<exists-path><globally>P</globally></exists-path>", "EG P"),
        ("<exists-path><next>P</next></exists-path>", "EX P"),
        ("<all-paths><finally>P</finally></all-paths>", "AF P"),
        ("<all-paths><globally>P</globally></all-paths>", "AG P"),
        ("<all-paths><next>P</next></all-paths>", "AX P"),
        ("<exists-path><until><before>P</before><reach>Q</reach></until></exists-path>", "E [P U Q]"),
        ("<all-paths><until><before>P</before><reach>Q</reach></until></all-paths>", "A [P U Q]"),
        (
            "<all-paths><globally><implication>P<exists-path><until>
               <before><negation><all-paths><next>Q</next></all-paths></negation></before>
               <reach><exists-path><finally>Q</finally></exists-path></reach>
             </until></exists-path></implication></globally></all-paths>",
            "AG (P -> E [!AX Q U EF Q])",
        ),
    ];
    for (xml, expected) in cases {
        let read = text(&xml.replace('P', P).replace('Q', Q));
        assert_eq!(read.replace("enabled(\"t\")", "P").replace("enabled(\"u\")", "Q"), expected, "{xml}");
    }
}

const ONE: &str = "<integer-constant> 1 </integer-constant>";
const TWO: &str = "<integer-constant>2</integer-constant>";
const TOKENS: &str = "<tokens-count><place>p</place></tokens-count>";

#[test]
fn every_comparison_is_read() {
    let signs = [("le", "<="), ("lt", "<"), ("eq", "="), ("ne", "!="), ("ge", ">="), ("gt", ">")];
    for (name, sign) in signs {
        let xml = format!("<integer-{name}>{ONE}{TOKENS}</integer-{name}>");
        assert_eq!(text(&xml), format!("1 {sign} tokens(\"p\")"));
    }
}

#[test]
fn every_number_is_read() {
    let cases = [
        ("<integer-constant>-3</integer-constant>".to_owned(), "-3"),
        ("<tokens-count><place>p</place><place>q</place></tokens-count>".to_owned(), "#p + #q"),
        (format!("<integer-sum>{TOKENS}{TWO}{ONE}</integer-sum>"), "#p + 2 + 1"),
        (format!("<integer-difference>{TOKENS}{TWO}</integer-difference>"), "#p - 2"),
        (format!("<integer-product>{TOKENS}{TWO}</integer-product>"), "#p * 2"),
        (
            format!("<integer-difference>{TWO}<integer-sum>{TOKENS}{ONE}</integer-sum></integer-difference>"),
            "2 - (#p + 1)",
        ),
    ];
    for (xml, expected) in cases {
        let read = text(&format!("<integer-lt>{ONE}{xml}</integer-lt>"));
        let short = read.replace("tokens(\"p\")", "#p").replace("tokens(\"q\")", "#q");
        assert_eq!(short, format!("1 < {expected}"), "{xml}");
    }
}

#[test]
fn properties_come_in_their_order_with_their_ids_and_places() {
    let properties = properties(&set("
        <!-- a comment -->
        <property><id> second </id><description>of <b>people</b></description><formula><true/></formula></property>
        <property>
          <formula><place-bound><place>p</place><place><!-- here -->q&#45;1</place></place-bound></formula>
          <id>first</id>
        </property>"));
    assert_eq!(properties.iter().map(|property| property.id.as_str()).collect::<Vec<_>>(), ["second", "first"]);
    assert!(matches!(properties[0].query, Query::Holds(_)));
    let Query::Bound(places) = &properties[1].query else { panic!("{properties:?}") };
    assert_eq!(places.iter().map(|place| place.id.as_str()).collect::<Vec<_>>(), ["p", "q-1"]);
}

#[test]
fn ids_are_found_where_they_stand() {
    let text =
        property("<is-fireable>\n <transition>t</transition>\n <transition> nowhere </transition></is-fireable>");
    let source = Source::new("test.xml", text.as_str());
    let net = net();
    let Query::Holds(formula) = &properties(&text)[0].query else { panic!("{text}") };
    let errors = bind_in_net(formula, &Nodes::by_id([], [("t", net.transition_ids().next().unwrap())])).unwrap_err();
    let [error] = errors.as_slice() else { panic!("{errors:#?}") };
    assert_eq!(error.message, "the net has no transition with the id `nowhere`");
    assert_eq!((source.slice(error.span()), source.line_column(error.span().start)), ("nowhere", (4, 15)));
}

#[test]
fn documents_that_are_no_property_set_are_refused_whole() {
    let cases = [
        ("", "1:1 E0501 this is no well-formed XML: the document does not have a root node"),
        ("<pnml/>", "1:1 E0501 this is no property file but `<pnml>`"),
        (
            "<property-set>\n</property>",
            "2:1 E0501 this is no well-formed XML: expected 'property-set' tag, not 'property'",
        ),
        ("<!DOCTYPE x []>\n<property-set/>", "1:1 E0501 a document type declaration is not part of a property file"),
        ("<property-set/>", "1:1 E0501 this file holds no property"),
    ];
    for (text, expected) in cases {
        assert_eq!(problems(text), [expected], "{text}");
    }
}

#[test]
fn what_is_not_understood_is_refused_all_at_once() {
    let text = set("<property><id>a</id><formula><negation><true/><true/></negation></formula></property>
<property><id>b</id><formula><conjunction/></formula></property>
<property><id>c</id><formula><finaly/></formula></property>
<property><id/><formula><is-fireable><place>p</place><transition/></is-fireable></formula></property>
<property><id>e</id></property>
<property><formula><true/></formula></property>
<property><id>g</id><formula/></property>
<property><id>h</id><formula><true/></formula><formula><true/></formula></property>
<property><id>i</id><formula><all-paths><globaly><true/></globaly></all-paths></formula></property>
<property><id>j</id><formula><negation>not <true/></negation></formula></property>
<property><id>k</id><formula><negation kind='strong'><true/></negation></formula></property>
<property><id>l</id><formula><conjunction><place-bound><place>p</place></place-bound><true/></conjunction></formula></property>
<property><id>m</id><formula><all-paths><until><reach><true/></reach><before><true/></before></until></all-paths></formula></property>
<property><id>n</id><formula><tokens-count><place>p</place></tokens-count></formula></property>
<property><id>o</id><formula><integer-eq><true/><tokens-count/></integer-eq></formula></property>
<property><id>p</id><formula><integer-lt><integer-constant>1.5</integer-constant><integer-constant>36893488147419103232</integer-constant></integer-lt></formula></property>
<property><id>q</id><formula><integer-lt><integer-constnt>1</integer-constnt><integer-constant/></integer-lt></formula></property>
<property><id>r</id><formula><true>TRUE</true></formula></property>
<property><id>s</id><formula><is-fireable><transition><b>t</b></transition></is-fireable></formula></property>
<properties/>
<property><id>u</id><tags/><formula><false/></formula></property>
<property><id>u</id><formula><false/></formula></property>");
    assert_eq!(
        problems(&text),
        [
            "2:30 E0501 `<negation>` holds one element, here are 2",
            "3:30 E0501 this `<conjunction>` has no operands",
            "4:30 E0501 `<finaly>` cannot stand here",
            "5:11 E0501 this `<id>` is empty",
            "5:38 E0501 expected `<transition>`, found `<place>`",
            "5:54 E0501 this `<transition>` is empty",
            "6:1 E0501 this property has no `<formula>`",
            "7:1 E0501 this property has no `<id>`",
            "8:21 E0501 `<formula>` holds one element, here are 0",
            "9:47 E0501 this property has a second `<formula>`",
            "10:41 E0501 `<globaly>` cannot stand here",
            "11:40 E0501 there is text in `<negation>`, which holds elements only",
            "12:40 E0501 `<negation>` has no attribute `kind`",
            "13:43 E0501 `<place-bound>` is a question of its own, not part of a formula",
            "14:48 E0501 expected `<before>`, found `<reach>`",
            "14:70 E0501 expected `<reach>`, found `<before>`",
            "15:30 E0503 `<tokens-count>` is a number, where something true or false is needed",
            "16:42 E0503 `<true>` is true or false, where a number is needed",
            "16:49 E0501 this `<tokens-count>` holds no `<place>`",
            "17:60 E0501 `1.5` is no whole number of 64 bits",
            "17:100 E0501 `36893488147419103232` is no whole number of 64 bits",
            "18:42 E0501 `<integer-constnt>` cannot stand here",
            "18:78 E0501 this `<integer-constant>` is empty",
            "19:36 E0501 there is text in `<true>`, which holds elements only",
            "20:55 E0501 there is an element in `<transition>`, which holds text only",
            "21:1 E0501 expected `<property>`, found `<properties>`",
            "22:21 E0501 `<tags>` cannot stand here",
            "23:15 E0504 there are two properties with the id `u`",
        ]
    );
}

#[test]
fn ltl_is_refused_once_a_formula() {
    let finally = |f: &str| format!("<finally>{f}</finally>");
    let formulas = [
        format!("<all-paths><globally>{}</globally></all-paths>", finally(P)),
        format!("<all-paths><conjunction>{}{}</conjunction></all-paths>", finally(P), finally(Q)),
        format!("<all-paths><globally><disjunction>{}{}</disjunction></globally></all-paths>", finally(P), finally(Q)),
        finally(P),
        format!("<all-paths>{P}</all-paths>"),
    ];
    let text: String =
        formulas.iter().map(|f| format!("<property><id>{}</id><formula>{f}</formula></property>\n", f.len())).collect();
    let (_, errors) = read(&Source::new("test.xml", set(&text)));
    let said: Vec<_> = errors.iter().map(|e| (e.message.as_str(), e.labels[0].text.as_str())).collect();
    let (no_quantifier, no_operator) =
        ("`<finally>` stands in no quantifier of its own", "`<all-paths>` has no path operator directly in it");
    assert_eq!(
        said,
        [no_quantifier, no_operator, no_quantifier, no_quantifier, no_operator]
            .map(|here| ("formulas of LTL are not read", here))
    );
}

#[test]
fn deep_formulas_are_refused_and_large_ones_are_not() {
    let nested = |open: &str, close: &str, n: usize| property(&format!("{}{P}{}", open.repeat(n), close.repeat(n)));
    let pairs = [
        ("<negation>", "</negation>"),
        ("<all-paths><finally>", "</finally></all-paths>"),
        ("<conjunction><true/>", "</conjunction>"),
        ("<exists-path><until><before><true/></before><reach>", "</reach></until></exists-path>"),
    ];
    let deep = "E0501 this formula is nested more than 500 levels deep";
    for (open, close) in pairs {
        assert_eq!(problems(&nested(open, close, 500)), [""; 0], "{open}");
        for n in [501, 100_000] {
            let problems = problems(&nested(open, close, n));
            assert!(matches!(problems.as_slice(), [only] if only.ends_with(deep)), "{open}: {problems:?}");
        }
    }
    // A formula at the depth limit is processed without harm.
    let Query::Holds(formula) = properties(&nested("<negation>", "</negation>", 500)).remove(0).query else { panic!() };
    let bound = bind_in_net(&formula, &net().nodes()).unwrap();
    assert_eq!(bound.text(&net()), "!".repeat(500) + "enabled(\"t\")");
    assert_eq!(bound.simplified().text(&net()), "enabled(\"t\")");
    // A thousand operands add ten levels: 2^10 is 1024.
    let wide = format!("<conjunction>{}", "<true/>".repeat(999));
    assert_eq!(problems(&nested(&wide, "</conjunction>", 50)), [""; 0]);
    assert_eq!(problems(&nested(&wide, "</conjunction>", 51)).len(), 1);
}

#[test]
fn thousands_of_names_make_a_shallow_formula() {
    let transitions = "<transition>t</transition>".repeat(100_000);
    let places = "<place>p</place>".repeat(100_000);
    let large = format!(
        "<conjunction><is-fireable>{transitions}</is-fireable><integer-le><integer-constant>7</integer-constant>\
         <tokens-count>{places}</tokens-count></integer-le></conjunction>"
    );
    let net = net();
    let Query::Holds(formula) = properties(&property(&large)).remove(0).query else { panic!("a bound") };
    let text = bind_in_net(&formula, &net.nodes()).unwrap().text(&net);
    assert_eq!(text.matches("enabled(\"t\")").count(), 100_000);
    assert_eq!(text.matches("tokens(\"p\")").count(), 100_000);
    // 2^17 is more than 100,000, so there are 17 levels of operands; the names have parentheses of their own.
    let (mut depth, mut deepest) = (0, 0);
    for letter in text.chars() {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        deepest = deepest.max(depth);
    }
    assert!((10..=18).contains(&deepest), "{deepest}");
}
