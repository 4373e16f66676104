//! Tests of the reader: nets, and diagnostics of invalid input.

use super::{read, read_safe};
use crate::net::{Arcs, Located, PlaceId, TransitionId};
use petril_base::source::Source;

/// A document around the content of its page, which begins in line 2.
fn document(page: &str) -> String {
    let (pnml, net) =
        ("http://www.pnml.org/version-2009/grammar/pnml", "http://www.pnml.org/version-2009/grammar/ptnet");
    format!("<pnml xmlns='{pnml}'><net id='net' type='{net}'><page id='page'>\n{page}\n</page></net></pnml>")
}

fn read_page(page: &str) -> Located {
    read(&Source::new("test.pnml", document(page))).unwrap_or_else(|errors| panic!("{page}\n{errors:#?}"))
}

/// Diagnostics of a text, as `line:column code message`.
fn problems(text: &str) -> Vec<String> {
    let source = Source::new("test.pnml", text);
    let errors = read_safe(&source).expect_err(text);
    let line = |d: &petril_base::diagnostic::Diagnostic| {
        let (line, column) = source.line_column(d.span().start);
        format!("{line}:{column} {} {}", d.code, d.message)
    };
    errors.iter().map(line).collect()
}

fn problems_of_page(page: &str) -> Vec<String> {
    problems(&document(page))
}

#[test]
fn labels_are_trimmed_and_everything_else_is_passed_over() {
    let file = read_page(
        "<name><text>the page</text></name>
        <place id='a'>
          <name><graphics><offset x='1' y='2'/></graphics><text>
            {S1=1} <!-- a comment -->&amp; more
          </text></name>
          <initialMarking><text> 01 </text><toolspecific tool='x' version='1'/></initialMarking>
          <graphics><position x='1' y='2'/></graphics>
        </place>
        <place id='b'><name/><initialMarking><text>0</text></initialMarking></place>
        <transition id='t'><toolspecific tool='x' version='1'><place id='a'/><transition/></toolspecific></transition>
        <arc id='x' source='a' target='t'><inscription><text>1</text></inscription></arc>
        <arc id='y' source='t' target='a'/>
        <arc id='z' source='t' target='b'><graphics><position x='1' y='2'/></graphics></arc>",
    );
    let net = &file.net;
    let places: Vec<_> = net.places().map(|place| (place.name, place.is_marked())).collect();
    assert_eq!(places, [("{S1=1} & more", true), ("b", false)], "names in braces are names");
    let ids: Vec<_> = net.place_ids().collect();
    let arcs = net.arcs(TransitionId::at(0));
    assert_eq!(arcs, Arcs { consume: &[], produce: &[ids[1]], read: &[ids[0]] }, "a loop is a read arc");
    assert_eq!(net.name(), "net", "its id: it has no name");
}

#[test]
fn pages_and_references_make_one_net() {
    let file = read_page(
        "<page id='one'>
           <place id='p'/><referenceTransition id='rt' ref='t'/><arc id='x' source='p' target='rt'/>
           <page id='inner'><transition id='t'><name><text>go</text></name></transition></page>
         </page>
         <page id='two'>
           <referencePlace id='r1' ref='r2'/><referencePlace id='r2' ref='q'/>
           <arc id='y' source='t' target='r1'/>
         </page>
         <place id='q'/>",
    );
    let net = &file.net;
    let names: Vec<_> = net.places().map(|place| place.name).collect();
    assert_eq!(names, ["q", "p"], "page by page, the outer one first");
    let find = |name| net.find_place(name).unwrap();
    let arcs = net.arcs(TransitionId::at(0));
    assert_eq!(arcs, Arcs { consume: &[find("p")], produce: &[find("q")], read: &[] });
}

#[test]
fn names_that_are_taken_give_way_to_ids() {
    let place = |id: &str, name: &str| format!("<place id='{id}'><name><text>{name}</text></name></place>");
    let places = [place("a", "x"), place("b", "x"), place("c", "d"), place("d", "x"), "<place id='x'/>".to_owned()];
    let net = read_page(&format!("{}<transition id='t'><name><text>x</text></name></transition>", places.concat())).net;
    let names: Vec<_> = net.places().map(|place| place.name).collect();
    assert_eq!(names, ["x", "b", "d", "d'2", "x'3"], "an id gives way to a name");
    assert_eq!(net.transition(TransitionId::at(0)).name, "x", "transitions have names of their own");
}

#[test]
fn spans_are_those_of_the_names() {
    let page = "<place id='a'><name><text> S1=1\n</text></name></place><transition id='t'/>";
    let source = Source::new("n", document(page));
    let file = read(&source).unwrap();
    assert_eq!(source.slice(file.places[0]), "S1=1");
    assert_eq!(source.slice(file.transitions[0]), "t");
}

#[test]
fn everything_that_is_wrong_is_reported_at_once() {
    let page = "<place id='a'><initialMarking><text> 3 </text></initialMarking></place>
<place id='a'/><place/><transition id='t'/><transition id='u'/>
<place id='b'><initialMarking><text>one</text></initialMarking><capacity/></place>
<place id='c'><initialMarking/></place>
<referencePlace id='r' ref='nobody'/><referencePlace id='s' ref='t'/><referencePlace id='v'/>
<referenceTransition id='x' ref='y'/><referenceTransition id='y' ref='x'/>
<arc source='a' target='b'/><arc source='t' target='x'/><arc source='u' target='t'/>
<arc source='a' target='nowhere'/><arc source='a' target='t'><inscription><text>2</text></inscription></arc>
<arc source='t' target='b'/>
<arc source='t' target='b'><type value='inhibitor'/></arc><arc source='t'/><labels/>";
    assert_eq!(
        problems_of_page(page),
        [
            "2:38 E0402 the place `a` has 3 tokens at the beginning",
            "3:12 E0403 the id `a` is given twice",
            "3:16 E0401 this `<place>` has no attribute `id`",
            "4:37 E0401 `one` is no natural number",
            "4:64 E0402 `<capacity>` in `<place>` is not part of place/transition nets",
            "5:15 E0401 this `<initialMarking>` has no `<text>`",
            "6:29 E0403 there is no place or transition with the id `nobody`",
            "6:66 E0403 a reference place cannot stand for the transition `t`",
            "6:70 E0401 this `<referencePlace>` has no attribute `ref`",
            "7:34 E0403 the reference node `x` stands for itself in a circle",
            "8:14 E0403 this arc joins two places, `a` and `b`",
            "8:70 E0403 this arc joins two transitions, `u` and `t`",
            "9:25 E0403 there is no place or transition with the id `nowhere`",
            "9:81 E0402 this arc has weight 2",
            "11:14 E0402 two arcs join `b` and `t` in the same direction",
            "11:28 E0402 `<type>` in `<arc>` is not part of place/transition nets",
            "11:59 E0401 this `<arc>` has no attribute `target`",
            "11:76 E0402 `<labels>` in `<page>` is not part of place/transition nets",
        ]
    );
}

#[test]
fn weights_and_tokens_are_read_and_noted_where_they_stand() {
    let page = "<place id='a'><initialMarking><text> 3 </text></initialMarking></place><transition id='t'/>
<arc source='a' target='t'><inscription><text>2</text></inscription></arc>
<arc source='t' target='a'/><arc source='t' target='a'/><arc source='t' target='a'/>
<place id='b'><initialMarking><text>0</text></initialMarking></place>
<arc source='b' target='t'><inscription><text>0</text></inscription></arc>";
    assert_eq!(problems_of_page(page).len(), 5);
    assert!(problems_of_page(page).contains(&"6:47 E0402 this arc has weight 0".to_owned()));
    let page = page.replace("<text>0<", "<text>1<");
    assert_eq!(
        problems_of_page(&page),
        [
            "2:38 E0402 the place `a` has 3 tokens at the beginning",
            "3:47 E0402 this arc has weight 2",
            "4:42 E0402 two arcs join `a` and `t` in the same direction",
            "4:70 E0402 two arcs join `a` and `t` in the same direction",
        ]
    );
    let file = read_page(&page);
    let (a, b, t) = (PlaceId::at(0), PlaceId::at(1), TransitionId::at(0));
    assert_eq!(file.net.initial_tokens().as_slice(), [3, 1]);
    assert_eq!(file.net.pre(t).collect::<Vec<_>>(), [(a, 2), (b, 1)]);
    assert_eq!(file.net.post(t).collect::<Vec<_>>(), [(a, 3)]);
    assert_eq!(file.ids, Some((vec!["a".to_owned(), "b".to_owned()], vec!["t".to_owned()])));
    assert_eq!(read(&Source::new("n", super::write(&file.net, super::Extras::default()))).unwrap().net, file.net);
}

#[test]
fn arcs_through_a_reference_are_parallel_to_arcs_of_the_node() {
    let page = "<place id='p'/><transition id='t'/><referencePlace id='r' ref='p'/>
<arc id='x' source='p' target='t'/>
<arc id='y' source='r' target='t'/>";
    assert_eq!(problems_of_page(page), ["4:21 E0402 two arcs join `p` and `t` in the same direction"]);
}

#[test]
fn documents_that_are_no_place_transition_net_are_refused_whole() {
    let table = [
        ("<pnml>\n <net></pnml>", "2:7 E0401 this is no well-formed XML: expected 'net' tag, not 'pnml'"),
        ("<pnml>\n", "1:7 E0401 this is no well-formed XML: the root node was opened but never closed"),
        ("<!DOCTYPE pnml><pnml/>", "1:1 E0401 a document type declaration is not part of PNML"),
        ("<pnml>\n<ä b='&x;'/></pnml>", "2:7 E0401 this is no well-formed XML: unknown entity reference 'x'"),
        ("<svg/>", "1:1 E0401 this is no PNML but `<svg>`"),
        ("<pnml/>", "1:1 E0401 this document holds no net"),
        ("<pnml><net/></pnml>", "1:7 E0401 this net has no type"),
        ("<pnml><net type='timed'/></pnml>", "1:18 E0401 this net has the type `timed`"),
        ("<pnml><net/><net/><net/></pnml>", "1:13 E0401 this document holds 3 nets"),
    ];
    for (text, problem) in table {
        assert_eq!(problems(text), [problem], "{text}");
    }
}

#[test]
fn deep_and_long_documents_cost_neither_stack_nor_patience() {
    let n = 100_000;
    assert_eq!(problems(&"<a>".repeat(n)).len(), 1);
    let pages = (0..n).map(|i| format!("<page id='q{i}'>")).collect::<String>();
    assert_eq!(read_page(&format!("{pages}<place id='p'/>{}", "</page>".repeat(n))).net.places().len(), 1);
    let chain = (0..n).map(|i| format!("<referencePlace id='r{i}' ref='r{}'/>", i + 1)).collect::<String>();
    let page = format!("<transition id='t'/><arc source='r0' target='t'/>{chain}<place id='r{n}'/>");
    assert_eq!(read_page(&page).net.arc_count(), 1);
    assert_eq!(problems_of_page(&page.replace(&format!("<place id='r{n}'/>"), "")).len(), 1);
    assert_eq!(problems_of_page(&"<place id='p'/>".repeat(n / 10)).len(), n / 10 - 1);
}
