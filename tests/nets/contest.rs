//! Properties of the Model Checking Contest, with the answers that others agreed on. They are not part of this project:
//! `PETRIL_DATA` names the folder that holds them, with the contest's archives in `mcc/`. Without it there is only a net of
//! our own to test here.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::exchange::mcc::{self, Query};
use petril::exchange::tina;
use petril::explore::engine::{Model, Options};
use petril::explore::{Budget, Markings, Stop, engine};
use petril::logic::{Bound, Dag, MarkingValuation, Nodes, Valuation, bind_in_net, label, parse_formula};
use petril::net::{Net, PlaceId, TransitionId};
use petril::source::Source;
use petril::verdict::{Examination, Question, Reply, Run, judge};
use support::contest::{Instance, instances, source};

/// The markings of a net.
struct Whole<'n>(Markings<'n>);

impl<'n> Whole<'n> {
    /// Nothing if there are more of them than this, or a place can get a second token.
    fn of(net: &'n Net, limit: u64) -> Option<Self> {
        let markings = Markings::explored(net, Budget { states: limit, ..Budget::default() }, &mut |_| None);
        markings.graph().is_complete().then_some(Self(markings))
    }

    fn valuation(&self, state: u32) -> MarkingValuation<'_> {
        MarkingValuation(&self.0, self.0.graph().state(state))
    }

    /// Whether a formula holds at the beginning.
    fn holds(&self, formula: &Bound) -> bool {
        let mut dag = Dag::default();
        let node = dag.add(formula, false);
        let labels = label(self.0.graph(), &dag, &|f, state| f.holds_in(&self.valuation(state)).unwrap(), None);
        self.0.graph().initial().iter().all(|&state| labels.of(node).contains(state as usize))
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
                self.0.graph().ids().map(sum).max().unwrap().to_string()
            }
        }
    }
}

/// The answers that the engine gives to all properties at once.
fn judged(net: &Net, properties: &[mcc::Property], nodes: &Nodes<'_>) -> Vec<String> {
    let known = replies(net, &questions(properties, nodes), Options { threads: 2, ..Options::default() });
    known.into_iter().map(|answer| answer.unwrap_or_else(|reason| panic!("{reason}"))).collect()
}

fn questions(properties: &[mcc::Property], nodes: &Nodes<'_>) -> Vec<Question> {
    let question = |property: &mcc::Property| match &property.query {
        Query::Holds(formula) => Question::Holds(bind_in_net(formula, nodes).unwrap().simplified()),
        Query::Bound(places) => {
            Question::Most(nodes.places(places.iter().map(|place| (place.id.as_str(), place.span))).unwrap())
        }
    };
    properties.iter().map(question).collect()
}

/// What is known, or why it is not.
fn replies(net: &Net, questions: &[Question], options: Options) -> Vec<Result<String, String>> {
    let report = judge(net, questions, &options, &mut |_| None);
    let answer = |reply: &Reply| match reply {
        Reply::Holds(_) => Ok("TRUE".to_owned()),
        Reply::Violated(_) => Ok("FALSE".to_owned()),
        Reply::Most(most) => Ok(most.to_string()),
        Reply::Unknown(reason) => Err(reason.clone()),
    };
    report.replies.iter().map(answer).collect()
}

/// Two lamps: the first can be switched on and then off again, the second breaks when it is on.
const LAMPS: &str = "pl off1 (1)\npl off2 (1)\ntr switch1 off1 -> on1\ntr back1 on1 -> off1\n\
                     tr switch2 off2 -> on2\ntr break2 on2 on1 -> broken\n";

#[test]
fn answers_are_those_worked_out_by_hand() {
    let net = tina::read(&Source::new("lamps.net", LAMPS)).unwrap().net;
    let markings = Whole::of(&net, 100).unwrap();
    // off1 or on1 with off2 or on2; or the lamp is broken, which takes the token of on1, and nothing goes on.
    assert_eq!(markings.0.graph().len(), 5);
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
    let nodes = net.nodes();
    for (formula, expected) in formulas.chain(bounds) {
        let text = format!("<property-set><property><id>x</id><formula>{formula}</formula></property></property-set>");
        let (properties, errors) = mcc::read(&Source::new("lamps.xml", text));
        assert!(errors.is_empty(), "{errors:#?}");
        assert_eq!(markings.answer(&properties[0].query, &nodes), expected, "{formula}");
        assert_eq!(judged(&net, &properties, &nodes), [expected], "{formula}");
    }
}

/// The runs that show answers are the shortest ones, and those without end go round.
#[test]
fn answers_are_shown_by_runs() {
    let net = tina::read(&Source::new("lamps.net", LAMPS)).unwrap().net;
    let run = |text: &str| {
        let parsed = parse_formula(&Source::new("f", text)).unwrap();
        let formula = bind_in_net(&parsed, &net.nodes()).unwrap();
        let report = judge(&net, &[Question::Holds(formula)], &Options::default(), &mut |_| None);
        let (word, run) = match &report.replies[0] {
            Reply::Holds(run) => ("holds", run),
            Reply::Violated(run) => ("violated", run),
            other => panic!("{other:?}"),
        };
        let names = |firings: &[TransitionId]| -> String {
            firings.iter().map(|&id| net.transition(id).name).collect::<Vec<_>>().join(" ")
        };
        let run = run.as_ref().map(|run| format!("{} / {:?}", names(&run.firings), run.loop_start));
        format!("{word}: {}", run.unwrap_or_else(|| "no run".to_owned()))
    };
    assert_eq!(run("EF at deadlock"), "holds: switch1 switch2 break2 / None");
    assert_eq!(run(r#"AG (tokens("on1") + tokens("on2") < 2)"#), "violated: switch1 switch2 / None");
    assert_eq!(run(r#"AG (tokens("on1") <= 1)"#), "holds: no run");
    assert_eq!(run(r#"EF (tokens("on1") > 1)"#), "violated: no run");
    assert_eq!(run(r#"AF marked("on2")"#), "violated: switch1 back1 / Some(0)");
    assert_eq!(run(r#"EG !marked("on2")"#), "holds: switch1 back1 / Some(0)");
    assert_eq!(run(r#"AG EF enabled("switch2")"#), "violated: switch2 / None");
}

/// What cannot be told by one run is told by runs that branch off it, and by what holds where they end.
#[test]
fn answers_are_shown_by_trees() {
    let net = tina::read(&Source::new("lamps.net", LAMPS)).unwrap().net;
    fn told(run: &Run, net: &Net) -> String {
        let mut parts: Vec<String> = run.firings.iter().map(|&id| net.transition(id).name.to_owned()).collect();
        parts.extend(run.loop_start.map(|start| format!("again {start}")));
        for branch in &run.branches {
            let run = branch.run.as_ref().map(|run| format!(": {}", told(run, net))).unwrap_or_default();
            parts.push(format!("[{} {}{run}]", branch.at, branch.formula.text(net)));
        }
        parts.join(" ")
    }
    let tree = |question: Question| match &judge(&net, &[question], &Options::default(), &mut |_| None).replies[0] {
        Reply::Holds(run) => format!("holds: {}", run.as_ref().map(|run| told(run, &net)).unwrap_or_default()),
        Reply::Violated(run) => format!("violated: {}", run.as_ref().map(|run| told(run, &net)).unwrap_or_default()),
        other => panic!("{other:?}"),
    };
    let formula = |text: &str| {
        let parsed = parse_formula(&Source::new("f", text)).unwrap();
        tree(Question::Holds(bind_in_net(&parsed, &net.nodes()).unwrap()))
    };
    // With lamp 2 on, lamp 1 can be switched for ever, and it can break.
    assert_eq!(
        formula(r#"EF (marked("on2") & EG !marked("broken") & EF marked("broken"))"#),
        r#"holds: switch2 switch1 break2 [1 marked("on2") & EG !marked("broken"): switch1 back1 again 0]"#
    );
    assert_eq!(formula(r#"AG EF enabled("switch2")"#), r#"violated: switch2 [1 AG !enabled("switch2")]"#);
    assert_eq!(
        formula(r#"EF marked("broken") & !AF marked("on2")"#),
        r#"holds: [0 EF marked("broken"): switch1 switch2 break2] [0 !AF marked("on2"): switch1 back1 again 0]"#
    );
    assert_eq!(tree(Examination::ReachabilityDeadlock.question()), "holds: switch1 switch2 break2");
    assert_eq!(tree(Examination::OneSafe.question()), "holds: ");
    assert_eq!(tree(Examination::StableMarking.question()), "violated: ");
    assert_eq!(tree(Examination::QuasiLiveness.question()), "holds: ");
    let dead: Vec<String> =
        ["switch1", "back1", "switch2", "break2"].map(|name| format!("[3 AG !enabled(\"{name}\")]")).into();
    assert_eq!(tree(Examination::Liveness.question()), format!("violated: switch1 switch2 break2 {}", dead.join(" ")));
}

/// States, firings and tokens are those of the contest, on the nets of up to 300,000 states.
#[test]
fn state_spaces_are_those_of_the_contest() {
    let folder = tempfile::TempDir::new().unwrap();
    let (all, mut checked) = (instances(folder.path()), 0);
    for instance in all.iter().map(|folder| Instance::of(folder)) {
        let (name, oracle) = (&instance.name, instance.oracle("SS"));
        let known = |what: &str| -> Option<u64> {
            let line = oracle.lines().find_map(|line| line.strip_prefix(&format!("STATE_SPACE {what} ")))?;
            line.split(' ').next()?.parse().ok()
        };
        if known("STATES").is_none_or(|states| states > 300_000) {
            continue;
        }
        let exploration =
            engine::explore(&Model::from(&instance.located.net), &Options::default(), &mut |_| None, None);
        assert_eq!(exploration.stop, Stop::Complete, "{name}");
        let figures = exploration.figures;
        for (what, found) in [
            ("STATES", figures.states),
            ("TRANSITIONS", figures.transitions),
            ("MAX_TOKEN_IN_PLACE", figures.max_tokens_in_place),
            ("MAX_TOKEN_PER_MARKING", figures.max_tokens_in_marking),
        ] {
            assert_eq!(known(what).unwrap_or(found), found, "{name}: {what}");
        }
        checked += 1;
    }
    assert!(all.is_empty() || checked > 15, "{checked}");
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

fn limited(states: u64) -> Options {
    Options { budget: Budget { states, ..Budget::default() }, ..Options::default() }
}

/// On the nets that are small.
#[test]
fn answers_are_those_of_the_contest() {
    let folder = tempfile::TempDir::new().unwrap();
    let (all, mut checked) = (instances(folder.path()), Vec::new());
    for instance in all.iter().map(|folder| Instance::of(folder)) {
        let (name, read, nodes) = (&instance.name, &instance.located, instance.nodes());
        let small = |net: &Net| {
            engine::explore(&Model::from(net), &limited(30_000), &mut |_| None, None).stop == Stop::Complete
        };
        if !small(&read.net) {
            continue;
        }
        // What has weights, the engine alone explores.
        let markings = if read.not_safe.is_empty() { Whole::of(&read.net, 30_000) } else { None };
        for (file, short) in FILES {
            let (properties, expected) = (instance.properties(file), instance.answers(short));
            assert_eq!(judged(&read.net, &properties, &nodes), expected, "{name}: {file}");
            if let Some(markings) = &markings {
                let answers = properties.iter().map(|property| markings.answer(&property.query, &nodes));
                assert_eq!(answers.collect::<Vec<_>>(), expected, "{name}: {file}");
            }
        }
        for (examination, short) in Examination::ALL.into_iter().zip(["RD", "OS", "SM", "QL", "L"]) {
            let oracle = instance.oracle(short);
            let line = oracle.lines().find_map(|line| line.strip_prefix(&format!("FORMULA {} ", examination.name())));
            let expected = line.and_then(|line| line.split(' ').next()).unwrap();
            let answer = replies(&read.net, &[examination.question()], Options::default());
            assert_eq!(answer, [Ok(expected.to_owned())], "{name}: {examination:?}");
        }
        checked.push(name.clone());
    }
    assert!(all.is_empty() || checked.len() > 10, "{checked:?}");
}

/// On all of them, with a few states only: there are answers all the same, by walks, the state equation, reductions and stubborn
/// sets, and they are right.
#[test]
fn answers_from_few_states_are_those_of_the_contest() {
    let folder = tempfile::TempDir::new().unwrap();
    let (all, mut known, mut asked) = (instances(folder.path()), 0, 0);
    for instance in all.iter().map(|folder| Instance::of(folder)) {
        let (name, net, nodes) = (&instance.name, &instance.located.net, instance.nodes());
        for (file, short) in FILES {
            let (properties, expected) = (instance.properties(file), instance.answers(short));
            let answers = replies(net, &questions(&properties, &nodes), limited(300));
            for ((answer, expected), property) in answers.iter().zip(expected).zip(&properties) {
                let is_report = answer.as_ref().is_err_and(|reason| reason.contains("please report"));
                assert!(!is_report, "{name}: {answer:?}");
                let is_right = answer.as_ref().ok().is_none_or(|answer| *answer == expected || expected == "?");
                assert!(is_right, "{name}: {} is {expected}, not {answer:?}", property.id);
                known += usize::from(answer.is_ok());
                asked += 1;
            }
        }
    }
    // Two thirds of them, though few of those about paths.
    assert!(known * 3 >= asked * 2, "{known} of {asked}");
}
