//! Tests of the reader: nets, and diagnostics of invalid input.

use super::{read, read_safe};
use crate::net::{Arcs, PlaceId, TransitionId};
use petril_base::source::Source;

/// Diagnostics of a text, as `line:column code message`.
fn problems(text: &str) -> Vec<String> {
    let source = Source::new("test.net", text);
    let errors = read_safe(&source).expect_err(text);
    let line = |d: &petril_base::diagnostic::Diagnostic| {
        let (line, column) = source.line_column(d.span().start);
        format!("{line}:{column} {} {}", d.code, d.message)
    };
    errors.iter().map(line).collect()
}

/// The only diagnostic of a one-line text: message, text underlined, last help.
fn problem(text: &str) -> [String; 3] {
    let errors = read_safe(&Source::new("test.net", text)).expect_err(text);
    assert_eq!(errors.len(), 1, "{text}: {errors:?}");
    let [error] = &errors[..] else { panic!("{text}") };
    let help = error.help.last().cloned().unwrap_or_default();
    [error.message.clone(), text[error.span().range()].to_owned(), help]
}

#[test]
fn every_declaration_of_the_format_is_read() {
    let text = "# a comment\n\
        tr {t 1} : {a label} [0,w[ p*1 {q\\}}?1 -> q'2 # another\n\
        net {two words}\n\
        pl p : label (1)\r\n\
        pl unused\n\
        \t pl {q\\}}(0)\n\
        nt n 1 {a note}\n\
        lb p {an old label}\n\
        tr none\n\
        tr source->p\n\
        tr p p ->";
    let source = Source::new("folder/file.net", text);
    let file = read(&source).unwrap();
    let net = &file.net;
    assert_eq!(net.name(), "two words");
    let places: Vec<_> = net.places().map(|place| (place.name, place.is_marked())).collect();
    assert_eq!(places, [("p", true), ("q}", false), ("q'2", false), ("unused", false)]);
    let names: Vec<_> = net.transitions().map(|t| t.name).collect();
    assert_eq!(names, ["t 1", "none", "source", "p"], "a place and a transition may have one name");
    let [p, q, q2, _] = net.place_ids().collect::<Vec<PlaceId>>()[..] else { panic!("{net:?}") };
    let arcs = net.arcs(TransitionId::at(0));
    assert_eq!(arcs, Arcs { consume: &[p], produce: &[q2], read: &[q] });
    let at = |id| source.slice(file.place_span(id));
    assert_eq!([at(p), at(q), at(q2)], ["p", "{q\\}}", "q'2"]);
    assert_eq!(source.line_of(file.place_span(p).start), 4, "the declaration, not the first use");
    assert_eq!(source.line_of(file.place_span(q2).start), 2, "the first use: there is no declaration");
}

#[test]
fn several_declarations_stand_on_one_line() {
    let net =
        read(&Source::new("n", "net n pl p (1) tr t p -> q tr u q?1 -> {pl} r pl r (1) # all\npl q")).unwrap().net;
    let places: Vec<_> = net.places().map(|place| (place.name, place.tokens)).collect();
    assert_eq!(places, [("p", 1), ("q", 0), ("pl", 0), ("r", 1)]);
    assert_eq!(net.transitions().map(|t| t.name).collect::<Vec<_>>(), ["t", "u"]);
    assert_eq!(super::write(&net).lines().last(), Some("tr u q?1 -> {pl} r"), "a word is no name");
    assert_eq!(
        problem("tr t p -> tr"),
        [
            "expected a name, found the end of the line",
            "",
            "write a transition as `tr NAME PLACES -> PLACES` on one line"
        ]
    );
    assert_eq!(
        problem("pl net (1)"),
        ["expected a name, found `net`", "net", "`net` begins a declaration; a node of this name is written `{net}`"]
    );
    assert_eq!(problem("tr t p -> q [1,2] u")[0], "expected the end of the line or a name, found `[`");
}

#[test]
fn a_net_without_a_name_is_called_after_its_file() {
    assert_eq!(read(&Source::new("some/folder/doors.net", "pl p")).unwrap().net.name(), "doors");
    assert_eq!(read(&Source::new("-", "")).unwrap().net.name(), "-");
}

#[test]
fn every_bad_line_is_reported_and_the_others_are_still_looked_at() {
    let text = "net a\nnet b\npl p (2)\nfoo\npl q\ntr t p*2 -> p\ntr u p\npl q (1)\ntr t -> q\n\ntr v q -> q q # q\npr t > u\n";
    assert_eq!(
        problems(text),
        [
            "2:5 E0401 this net is named a second time",
            "3:6 E0402 the place `p` has 2 tokens at the beginning",
            "4:1 E0401 expected `net`, `pl` or `tr`, found `foo`",
            "6:6 E0402 this arc has weight 2",
            "7:7 E0401 expected `->` or a name, found the end of the line",
            "8:4 E0403 the place `q` is defined twice",
            "9:4 E0403 the transition `t` is defined twice",
            "11:13 E0402 two arcs join `q` and `v` in the same direction",
            "12:1 E0402 priorities between transitions are not part of place/transition nets",
        ]
    );
}

#[test]
fn weights_and_tokens_are_read_and_noted_where_they_stand() {
    let text = "pl p (2)\ntr t p*2 q?3 -> p q q\ntr u q*1K r?2 r -> r\n";
    assert_eq!(
        problems(text),
        [
            "1:6 E0402 the place `p` has 2 tokens at the beginning",
            "2:6 E0402 this arc has weight 2",
            "2:10 E0402 this arc tests for 3 tokens",
            "2:21 E0402 two arcs join `q` and `t` in the same direction",
            "3:6 E0402 this arc has weight 1K",
            "3:11 E0402 this arc tests for 2 tokens",
        ]
    );
    let net = read(&Source::new("test.net", text)).unwrap().net;
    let names = |arcs: Vec<(PlaceId, u64)>| -> Vec<_> {
        arcs.into_iter().map(|(place, weight)| (net.place(place).name, weight)).collect()
    };
    let [t, u] = [0, 1].map(TransitionId::at);
    assert_eq!(names(net.pre(t).collect()), [("p", 2), ("q", 3)]);
    assert_eq!(names(net.post(t).collect()), [("p", 1), ("q", 5)]);
    assert_eq!(names(net.pre(u).collect()), [("q", 1000), ("r", 2)], "the token taken is one of those tested");
    assert_eq!(names(net.post(u).collect()), [("r", 2)]);
    let written = super::write(&net);
    assert_eq!(written, "net test\npl p (2)\npl q\npl r\ntr t p*2 q?3 -> q*2 p\ntr u q*1000 r?2 ->\n");
    assert_eq!(read(&Source::new("test.net", written)).unwrap().net, net);
    assert_eq!(
        problem("pl p (9G)"),
        ["the place `p` has 9G tokens at the beginning", "(9G)", "a place of a safe net holds one token at most"]
    );
    assert_eq!(problem("pl p (9T)")[0], "9T tokens are more than can be counted");
    assert_eq!(problem("pl p (99999999999999999999)")[0], "99999999999999999999 tokens are more than can be counted");
}

#[test]
fn what_a_safe_net_does_not_have_is_refused_by_name() {
    let table = [
        ("tr t p*2 -> q", "this arc has weight 2", "p*2"),
        ("tr t p -> q*1K", "this arc has weight 1K", "q*1K"),
        ("tr t p*0 -> q", "this arc has weight 0", "p*0"),
        ("tr t p?3 -> q", "this arc tests for 3 tokens", "p?3"),
        ("tr t p?-1 -> q", "an inhibitor arc is not part of place/transition nets", "p?-1"),
        ("tr t p!1 -> q", "a stopwatch arc makes this a time net", "p!1"),
        ("tr t p!-1 -> q", "a stopwatch arc makes this a time net", "p!-1"),
        ("tr t [1,2] p -> q", "the interval `[1,2]` makes this a time net", "[1,2]"),
        ("tr t ]0,w[ p -> q", "the interval `]0,w[` makes this a time net", "]0,w["),
        ("tr t p p -> q", "two arcs join `p` and `t` in the same direction", "p"),
        ("tr t p -> q q", "two arcs join `q` and `t` in the same direction", "q"),
        ("pl p (007)", "the place `p` has 7 tokens at the beginning", "(007)"),
        ("tr t p*0M -> q", "this arc has weight 0", "p*0M"),
        ("pl p (1K)", "the place `p` has 1K tokens at the beginning", "(1K)"),
        ("pr a b < c", "priorities between transitions are not part of place/transition nets", "pr a b < c"),
    ];
    for (text, message, underlined) in table {
        assert_eq!(problem(text)[..2], [message, underlined], "{text}");
    }
}

#[test]
fn help_fits_the_slip() {
    let names = "put a name with other characters than letters, digits, `_` and `'` in braces";
    let braces = "a name in braces ends with `}`; a brace or backslash inside it is written `\\{`, `\\}`, `\\\\`";
    let table = [
        ("pl S1=0 (1)", "expected the end of the line or a marking like `(1)`, found `=`", names),
        ("tr t ä -> q", "expected the end of the line, `->` or a name, found `ä`", names),
        ("pl {S1=0 (1)", "expected a name, found `{`", braces),
        ("pl {S1{0} (1)", "expected a name, found `{`", braces),
        (
            "pl p t -> u",
            "expected the end of the line or a marking like `(1)`, found `t`",
            "write a place as `pl NAME (1)`, and its arcs in the lines of the transitions",
        ),
        (
            "tr t p q",
            "expected `->` or a name, found the end of the line",
            "write a transition as `tr NAME PLACES -> PLACES` on one line",
        ),
        (
            "tr t p -> q?1",
            "expected the end of the line or a name, found `?`",
            "only arcs to a transition can test: write the test before `->`",
        ),
        (
            "trr t p -> q",
            "expected `net`, `pl` or `tr`, found `trr`",
            "a line is `net NAME`, `pl PLACE (1)` or `tr NAME PLACES -> PLACES`",
        ),
    ];
    for (text, message, help) in table {
        let [found, _, last_help] = problem(text);
        assert_eq!([found.as_str(), last_help.as_str()], [message, help], "{text}");
    }
}

#[test]
fn long_and_hostile_texts_are_read_to_the_end() {
    let n = 20_000;
    let lines: String = (0..n).map(|i| format!("pl p{i} (1)\ntr t{i} p{i} -> q{i}\n")).collect();
    let net = read(&Source::new("n", lines)).unwrap().net;
    assert_eq!((net.places().len(), net.transitions().len()), (2 * n, n));
    let count = |text: String| read(&Source::new("n", text)).map_or_else(|errors| errors.len(), |_| 0);
    assert_eq!(count("pl {a\n".repeat(n)), n);
    assert_eq!(count("{".repeat(n)), 1);
    assert_eq!(count(format!("pl {}", "{\\{".repeat(n))), 1);
    assert_eq!(count(format!("tr t {}", "-> ".repeat(n))), 1);
    assert_eq!(count("\n".repeat(n)), 0);
    assert_eq!(count("#".repeat(n)), 0);
}
