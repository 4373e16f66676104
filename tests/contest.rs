//! Properties of the Model Checking Contest, with the answers that others agreed on. They are not part of this project:
//! `PETRIL_DATA` names the folder that holds them, with the contest's archives in `mcc/`. Without it there is only a net of
//! our own to test here.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use petril::exchange::mcc::{self, Query};
use petril::exchange::{pnml, tina};
use petril::explore::{Budget, Graph, MarkingSpace, explore};
use petril::logic::{Bound, Dag, MarkingValuation, Nodes, Valuation, bind_in_net, label};
use petril::net::{Net, PlaceId};
use petril::source::Source;

/// The markings of a net.
struct Markings<'n> {
    space: MarkingSpace<'n>,
    graph: Graph,
}

impl<'n> Markings<'n> {
    /// Nothing if there are more of them than this, or a place can get a second token.
    fn of(net: &'n Net, limit: u64) -> Option<Self> {
        let space = MarkingSpace::new(net);
        let graph = explore(&space, Budget { states: limit, ..Budget::default() }, &mut |_| None);
        graph.is_complete().then_some(Self { space, graph })
    }

    fn valuation(&self, state: u32) -> MarkingValuation<'_> {
        MarkingValuation(&self.space, self.graph.state(state))
    }

    /// Whether a formula holds at the beginning.
    fn holds(&self, formula: &Bound) -> bool {
        let mut dag = Dag::default();
        let node = dag.add(formula, false);
        let labels = label(&self.graph, &dag, &|f, state| f.holds_in(&self.valuation(state)).unwrap(), None);
        self.graph.initial().iter().all(|&state| labels.of(node).contains(state as usize))
    }

    /// The answer to a property.
    fn answer(&self, query: &Query, nodes: &Nodes<'_>) -> String {
        match query {
            Query::Holds(formula) => {
                let bound = bind_in_net(formula, nodes).unwrap_or_else(|e| panic!("{e:#?}"));
                let holds = self.holds(&bound);
                assert_eq!(self.holds(&bound.simplified()), holds);
                if holds { "TRUE" } else { "FALSE" }.to_owned()
            }
            Query::Bound(places) => {
                let names = places.iter().map(|place| (place.id.as_str(), place.span));
                let places: Vec<PlaceId> = nodes.places(names).unwrap_or_else(|e| panic!("{e:#?}"));
                let sum = |state| places.iter().map(|&place| self.valuation(state).tokens(place)).sum::<u64>();
                self.graph.ids().map(sum).max().unwrap().to_string()
            }
        }
    }
}

/// Two lamps: the first can be switched on and then off again, the second breaks when it is on.
const LAMPS: &str = "pl off1 (1)\npl off2 (1)\ntr switch1 off1 -> on1\ntr back1 on1 -> off1\n\
                     tr switch2 off2 -> on2\ntr break2 on2 on1 -> broken\n";

#[test]
fn answers_are_those_worked_out_by_hand() {
    let net = tina::read(&Source::new("lamps.net", LAMPS)).unwrap().net;
    let markings = Markings::of(&net, 100).unwrap();
    // off1 or on1 with off2 or on2; or the lamp is broken, which takes the token of on1, and nothing goes on.
    assert_eq!(markings.graph.len(), 5);
    let fireable = |name: &str| format!("<is-fireable><transition>{name}</transition></is-fireable>");
    let tokens = |places: &[&str]| {
        let places: String = places.iter().map(|place| format!("<place>{place}</place>")).collect();
        format!("<tokens-count>{places}</tokens-count>")
    };
    let number = |n: u64| format!("<integer-constant>{n}</integer-constant>");
    let two = |name: &str, a: &str, b: &str| format!("<{name}>{a}{b}</{name}>");
    let under = |quantifier: &str, operator: &str, f: &str| {
        format!("<{quantifier}><{operator}>{f}</{operator}></{quantifier}>")
    };
    let until = |quantifier: &str, f: &str, g: &str| {
        format!("<{quantifier}><until><before>{f}</before><reach>{g}</reach></until></{quantifier}>")
    };
    let not = |f: &str| format!("<negation>{f}</negation>");
    let lamps = tokens(&["off1", "on1", "off2", "on2", "broken"]);
    let both = two("integer-eq", &lamps, &number(2));
    let cases = [
        (under("exists-path", "finally", "<deadlock/>"), true),
        // Lamp 1 is switched for ever.
        (under("all-paths", "finally", "<deadlock/>"), false),
        // Dead markings are those without a transition to fire.
        (
            under("all-paths", "globally", &two("equivalence", "<deadlock/>", &two("integer-eq", &lamps, &number(1)))),
            true,
        ),
        (under("all-paths", "next", &both), true),
        (under("all-paths", "globally", &under("all-paths", "next", &both)), false),
        // In the dead marking there is no next one: AX FALSE holds, EX TRUE does not.
        (under("exists-path", "finally", &under("all-paths", "next", "<false/>")), true),
        (under("all-paths", "globally", &under("exists-path", "next", "<true/>")), false),
        (
            under(
                "all-paths",
                "globally",
                &two("implication", &fireable("break2"), &under("exists-path", "next", "<deadlock/>")),
            ),
            true,
        ),
        (two("conjunction", &fireable("switch1"), &fireable("switch2")), true),
        (two("exclusive-disjunction", &fireable("switch1"), &fireable("switch2")), false),
        (two("exclusive-disjunction", &fireable("switch1"), &fireable("break2")), true),
        (until("exists-path", &fireable("switch2"), &two("integer-ge", &tokens(&["on2"]), &number(1))), true),
        // Lamp 2 may never be switched.
        (until("all-paths", &fireable("switch2"), &two("integer-ge", &tokens(&["on2"]), &number(1))), false),
        (under("exists-path", "finally", &two("integer-lt", &tokens(&["off1", "on1"]), &number(1))), true),
        // When lamp 2 is switched on, nothing is left but to switch on lamp 1.
        (under("exists-path", "globally", &not(&two("integer-gt", &tokens(&["on1"]), &number(0)))), false),
        // The path that ends where it begins.
        (under("exists-path", "finally", &under("exists-path", "globally", "<deadlock/>")), true),
        (two("integer-ne", &tokens(&["off1"]), &tokens(&["on1"])), true),
        (two("integer-le", &tokens(&["off1"]), &tokens(&["on1"])), false),
    ];
    let bounds = [(&["on1"][..], "1"), (&["on1", "on2"], "2"), (&["on1", "off1", "broken"], "1")];
    let formulas = cases.into_iter().map(|(formula, holds)| (formula, if holds { "TRUE" } else { "FALSE" }));
    let bounds = bounds.map(|(places, bound)| (tokens(places).replace("tokens-count", "place-bound"), bound));
    let nodes = Nodes::by_name(&net);
    for (formula, expected) in formulas.chain(bounds) {
        let text = format!("<property-set><property><id>x</id><formula>{formula}</formula></property></property-set>");
        let (properties, errors) = mcc::read(&Source::new("lamps.xml", text));
        assert!(errors.is_empty(), "{errors:#?}");
        assert_eq!(markings.answer(&properties[0].query, &nodes), expected, "{formula}");
    }
}

/// The instances of the data, unpacked; empty without data.
fn instances(folder: &Path) -> Vec<PathBuf> {
    let archives = env::var_os("PETRIL_DATA").map(|data| Path::new(&data).join("mcc")).filter(|mcc| mcc.exists());
    let Some(archives) = archives else {
        eprintln!("there are no archives of the contest: nothing is tested");
        return Vec::new();
    };
    for archive in fs::read_dir(archives).unwrap().map(|entry| entry.unwrap().path()) {
        let tar = Command::new("tar").arg("xzf").arg(&archive).arg("-C").arg(folder).status();
        assert!(tar.is_ok_and(|status| status.success()), "{} cannot be unpacked", archive.display());
    }
    let mut instances: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(!instances.is_empty());
    instances.sort();
    instances
}

fn source(path: &Path) -> Source {
    Source::new(path.to_str().unwrap(), fs::read_to_string(path).unwrap())
}

/// The ids of the nodes of a kind in a net whose places and transitions stand on one page.
fn ids(net: &str, kind: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(net).unwrap();
    let nodes = document.descendants().filter(|node| node.tag_name().name() == kind);
    nodes.filter_map(|node| node.attribute("id").map(str::to_owned)).collect()
}

/// What a file asks, and what the short name of its oracle is.
const FILES: [(&str, &str); 5] = [
    ("ReachabilityCardinality", "RC"),
    ("ReachabilityFireability", "RF"),
    ("CTLCardinality", "CTLC"),
    ("CTLFireability", "CTLF"),
    ("UpperBounds", "UB"),
];

#[test]
fn every_property_of_the_contest_is_read_or_is_one_of_ltl() {
    let folder = tempfile::TempDir::new().unwrap();
    for instance in instances(folder.path()) {
        for (name, _) in FILES {
            let (properties, errors) = mcc::read(&source(&instance.join(format!("{name}.xml"))));
            assert_eq!((properties.len(), errors.len()), (16, 0), "{}: {name}", instance.display());
        }
        for name in ["LTLCardinality", "LTLFireability"] {
            let (properties, errors) = mcc::read(&source(&instance.join(format!("{name}.xml"))));
            let linear = errors.iter().filter(|error| error.message == "formulas of LTL are not read").count();
            // Some formulas of LTL happen to be formulas of CTL too.
            assert_eq!(properties.len() + linear, 16, "{}: {name}", instance.display());
            assert!(linear == errors.len() && linear > 0, "{}: {name}\n{errors:#?}", instance.display());
        }
    }
}

/// On the nets that are safe and small.
#[test]
fn answers_are_those_of_the_contest() {
    let folder = tempfile::TempDir::new().unwrap();
    let (all, mut checked) = (instances(folder.path()), Vec::new());
    for instance in &all {
        let model = source(&instance.join("model.pnml"));
        let Ok(read) = pnml::read(&model) else { continue };
        let Some(markings) = Markings::of(&read.net, 30_000) else { continue };
        let (places, transitions) = (ids(model.text(), "place"), ids(model.text(), "transition"));
        let transitions = transitions.iter().map(String::as_str).zip(read.net.transition_ids());
        let nodes = Nodes::by_id(places.iter().map(String::as_str).zip(read.net.place_ids()), transitions);
        let name = instance.file_name().unwrap().to_str().unwrap();
        for (file, short) in FILES {
            // The answers are in the order of the ids.
            let (mut properties, _) = mcc::read(&source(&instance.join(format!("{file}.xml"))));
            properties.sort_by(|a, b| a.id.cmp(&b.id));
            let oracle = fs::read_to_string(instance.join(format!("oracle/{name}-{short}.out"))).unwrap();
            let expected = oracle.lines().filter_map(|line| line.strip_prefix("FORMULA ")?.split(' ').nth(1));
            let answers = properties.iter().map(|property| markings.answer(&property.query, &nodes));
            let both: Vec<(String, &str)> = answers.zip(expected).collect();
            assert_eq!(both.len(), 16, "{name}: {file}");
            for ((answer, expected), property) in both.iter().zip(&properties) {
                assert_eq!(answer, expected, "{}", property.id);
            }
        }
        checked.push(name.to_owned());
    }
    assert!(all.is_empty() || checked.len() > 10, "{checked:?}");
}
