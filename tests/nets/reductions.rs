//! Each rule of the reductions alone, on nets made for it, with results worked out by hand.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::exchange::tina;
use petril::net::{Builder, Net, PlaceId, TransitionId};
use petril::source::Source;
use petril::structure::reduce::{Keep, LiftError, Options, Property, Reduced, Rule, Size, reduce, reduce_with};

use Property::{Deadlock, Paths, Reachability};

fn net(text: &str) -> Net {
    tina::read(&Source::new("a.net", text)).unwrap_or_else(|errors| panic!("{errors:?}")).net
}

fn keep(net: &Net, property: Property, places: &[&str]) -> Keep {
    Keep { places: places.iter().map(|name| net.find_place(name).unwrap()).collect(), ..Keep::nothing(property) }
}

/// The net that some rules leave, as a text, without its first line.
fn left(text: &str, property: Property, places: &[&str], rules: &[Rule]) -> String {
    let net = net(text);
    let reduced =
        reduce_with(&net, &keep(&net, property, places), &Options { rules: rules.to_vec(), ..Options::default() });
    body(&reduced)
}

/// The reduced net as a text, without its first line, and without what TINA needs around names.
fn body(reduced: &Reduced<'_>) -> String {
    tina::write(&reduced.net).lines().skip(1).collect::<Vec<_>>().join("; ").replace(['{', '}'], "")
}

fn names(net: &Net, run: &[TransitionId]) -> String {
    run.iter().map(|&id| net.transition(id).name).collect::<Vec<_>>().join(" ")
}

/// A run by names.
fn run(reduced: &Reduced<'_>, names: &str) -> Vec<TransitionId> {
    names.split_whitespace().map(|name| reduced.net.find_transition(name).unwrap()).collect()
}

#[test]
fn transitions_that_never_fire_go() {
    // b and c only feed each other; t asks for more than there will ever be; u can fire.
    let text = "pl a (1)\npl d (2)\ntr x b -> c\ntr y c -> b\ntr t d*3 a -> a\ntr u d*2 -> a";
    for property in [Reachability, Deadlock, Paths] {
        let all = left(text, property, &["a", "d"], &[Rule::Dead]);
        assert_eq!(all, "pl a (1); pl d (2); pl b; pl c; tr u d*2 -> a");
    }
}

#[test]
fn places_that_hold_nothing_back_go() {
    // a is only read, s only receives, g never gets less than it had.
    let text = "pl a (2)\npl p (1)\npl g (1)\ntr t a?2 p -> q s*3\ntr u q g -> p g*2";
    assert_eq!(left(text, Paths, &["p"], &[Rule::Unrestricting]), "pl p (1); pl q; tr t p -> q; tr u q -> p");
    // What is kept goes on counting.
    let all = left(text, Paths, &["a", "p", "g"], &[Rule::Unrestricting]);
    assert_eq!(all, "pl a (2); pl p (1); pl g (1); pl q; tr t p -> q; tr u q -> p g");
    // With a token less, t is held back.
    let all = left("pl a (1)\npl p (1)\ntr t a?2 p -> q", Paths, &["a", "p", "q"], &[Rule::Unrestricting]);
    assert_eq!(all, "pl a (1); pl p (1); pl q; tr t p a?2 -> q");
}

#[test]
fn common_factors_are_divided_out() {
    let text = "pl a (7)\ntr t a*2 -> b*6\ntr u b*3 -> a*4";
    assert_eq!(left(text, Paths, &[], &[Rule::Scaled]), "pl a (3); pl b; tr t a -> b*2; tr u b -> a*2");
    assert_eq!(left(text, Paths, &["a", "b"], &[Rule::Scaled]), "pl a (7); pl b; tr t a*2 -> b*6; tr u b*3 -> a*4");
}

#[test]
fn implied_places_go() {
    // q has always twice as many as p, and one more.
    let text = "pl p (1)\npl q (3)\ntr t p q*2 -> r\ntr u r -> p q*2";
    assert_eq!(left(text, Paths, &["r"], &[Rule::Implied]), "pl p (1); pl r; tr t p -> r; tr u r -> p");
    // p follows from q as well.
    assert_eq!(left(text, Paths, &["q"], &[Rule::Implied]), "pl q (3); pl r; tr t q*2 -> r; tr u r -> q*2");
    assert!(left(text, Paths, &["p", "q"], &[Rule::Implied]).contains("p q*2"), "both are kept");
    // With two tokens less it can hold t back, but then p cannot.
    let text = text.replace("(3)", "(1)");
    assert_eq!(left(&text, Paths, &["r"], &[Rule::Implied]), "pl q (1); pl r; tr t q*2 -> r; tr u r -> q*2");
    assert!(left(&text, Paths, &["p"], &[Rule::Implied]).contains("p q*2"), "p does not imply q");
}

#[test]
fn dominated_transitions_go() {
    let text = "pl a (1)\npl b (1)\ntr t a -> c\ntr u a -> c\ntr v a b?1 -> c\ntr w a b -> c";
    assert_eq!(left(text, Paths, &["a"], &[Rule::Dominated]), "pl a (1); pl b (1); pl c; tr t a -> c; tr w a b -> c");
    // Neither needs what the other does.
    let text = "pl a (1)\npl b (1)\npl d (1)\ntr t a b?1 -> c\ntr u a d?1 -> c";
    let all = left(text, Paths, &["a", "b", "d"], &[Rule::Dominated]);
    assert!(all.contains("tr t") && all.contains("tr u"), "{all}");
}

#[test]
fn transitions_without_effect_go_where_they_may() {
    let text = "pl a (1)\npl b\ntr t a -> b\ntr u b?1 ->\ntr v a?1 ->";
    assert_eq!(left(text, Reachability, &["a"], &[Rule::Idle]), "pl a (1); pl b; tr t a -> b");
    // Without u there would be a deadlock.
    assert_eq!(left(text, Deadlock, &["a"], &[Rule::Idle]), "pl a (1); pl b; tr t a -> b; tr u b?1 ->");
    assert!(left(text, Paths, &["a"], &[Rule::Idle]).contains("tr v"));
}

#[test]
fn transitions_that_two_others_replace_go() {
    let text = "pl a (1)\npl c (1)\ntr t a -> b\ntr u b -> c*2\ntr tu a c?1 -> c*2";
    assert_eq!(left(text, Deadlock, &["c"], &[Rule::Composed]), "pl a (1); pl c (1); pl b; tr t a -> b; tr u b -> c*2");
    assert!(left(text, Paths, &["c"], &[Rule::Composed]).contains("tu"));
}

#[test]
fn what_kept_places_do_not_depend_on_goes() {
    // v only takes, w is elsewhere; u matters because t needs b.
    let text = "pl a (1)\npl d (1)\ntr t b -> k\ntr u a -> b\ntr v a ->\ntr w d -> e";
    let all = left(text, Reachability, &["k"], &[Rule::Irrelevant]);
    assert_eq!(all, "pl a (1); pl d (1); pl b; pl k; pl e; tr t b -> k; tr u a -> b");
    assert!(left(text, Deadlock, &["k"], &[Rule::Irrelevant]).contains("tr w"));
}

#[test]
fn without_deadlocks_reachability_is_all_that_matters() {
    let text = "pl a (1)\ntr t -> b\ntr u a -> k";
    let rules = [Rule::Alive, Rule::Irrelevant];
    assert_eq!(left(text, Deadlock, &["k"], &rules), "pl a (1); pl b; pl k; tr u a -> k; tr always ->");
}

#[test]
fn what_follows_at_once_is_fired_at_once() {
    // Each h puts as many as it likes, each f takes one and needs nothing else.
    let text = "pl a (3)\ntr h1 a -> p*2\ntr h2 a -> p c\ntr f p -> q";
    let only = [Rule::PostAgglomeration];
    for property in [Reachability, Deadlock] {
        let all = left(text, property, &["a"], &only);
        assert_eq!(all, "pl a (3); pl c; pl q; tr h1..f a -> q*2; tr h2..f a -> c q");
    }
    let two = "pl a (1)\ntr h a -> p*2\ntr f p -> q\ntr g p -> r";
    let all = left(two, Deadlock, &["a"], &only);
    assert_eq!(all, "pl a (1); pl q; pl r; tr h..f a -> q*2; tr h..g a -> q r; tr h..g 2 a -> r*2");
    // Not where f is seen, needs more, or p is tested; not where two could take the first token.
    assert!(left(text, Reachability, &["q"], &only).contains("tr f p -> q"));
    assert!(left("pl a (3)\npl l (1)\ntr h a -> p\ntr f p l?1 -> q", Deadlock, &["a"], &only).contains("tr f p"));
    assert!(left("pl a (3)\ntr h a -> p\ntr f p -> q\ntr t p?1 a ->", Deadlock, &["a"], &only).contains("tr f p"));
    assert!(
        left("pl a (3)\npl p (1)\ntr h a -> p\ntr f p -> q\ntr g p -> r", Deadlock, &["a"], &only).contains("tr f p")
    );
    assert!(left(text, Paths, &["a"], &only).contains("tr f p -> q"));
}

#[test]
fn tokens_at_the_beginning_go_on_at_once() {
    let net = net("pl a (1)\npl p (2)\ntr h a -> p\ntr f p -> q");
    let options = Options { rules: vec![Rule::PostAgglomeration], ..Options::default() };
    let reduced = reduce_with(&net, &keep(&net, Deadlock, &["a"]), &options);
    assert_eq!(body(&reduced), "pl a (1); pl q (2); tr h..f a -> q");
    assert_eq!(names(&net, &reduced.lift(&run(&reduced, "h..f")).unwrap()), "f f h f");
}

#[test]
fn what_only_prepares_waits() {
    // h1 and h2 have their places to themselves.
    let text = "pl a (1)\npl b (1)\npl l (1)\ntr h1 a -> p\ntr h2 b -> p\ntr f p l -> k";
    let only = [Rule::PreAgglomeration];
    assert_eq!(
        left(text, Deadlock, &["k"], &only),
        "pl a (1); pl b (1); pl l (1); pl k; tr h1..f a l -> k; tr h2..f b l -> k"
    );
    // Now another one wants the token of h1.
    let disturbed = format!("{text}\ntr d a -> l");
    assert!(left(&disturbed, Deadlock, &["k"], &only).contains("tr h1 a -> p"));
    let free = [Rule::FreeAgglomeration];
    assert!(left(&disturbed, Deadlock, &["k"], &free).contains("tr h1 a -> p"));
    assert!(left(&disturbed, Reachability, &["k"], &free).contains("tr h1..f a l -> k"));
    // What is seen does not wait; nor what does more than prepare.
    assert!(left(text, Reachability, &["a"], &only).contains("tr h1 a -> p"));
    assert!(left(&text.replace("h2 b -> p", "h2 b -> p l"), Reachability, &["k"], &free).contains("tr h1 a -> p"));

    // There is one l only. In the dead marking of the original, both h have fired.
    let net = net(text);
    let options = Options { rules: only.to_vec(), ..Options::default() };
    let reduced = reduce_with(&net, &keep(&net, Deadlock, &["k"]), &options);
    assert_eq!(names(&net, &reduced.lift(&run(&reduced, "h1..f")).unwrap()), "h1 f h2");
}

#[test]
fn several_tokens_are_prepared_by_several() {
    let text = "pl a (2)\npl b (2)\ntr h1 a -> p\ntr h2 b -> p\ntr f p*2 -> k";
    let all = left(text, Deadlock, &["k"], &[Rule::PreAgglomeration]);
    assert_eq!(all, "pl a (2); pl b (2); pl k; tr h1..f a*2 -> k; tr h1..f 2 a b -> k; tr h2..f b*2 -> k");
}

#[test]
fn places_in_a_circle_become_one() {
    let text = "pl a (1)\npl b (1)\ntr ab a -> b\ntr bc b -> c\ntr ca c -> a\ntr t a b c*2 -> k\ntr u k -> c";
    let net = net(text);
    let options = Options { rules: vec![Rule::Fusion, Rule::Idle, Rule::Dominated], ..Options::default() };
    let reduced = reduce_with(&net, &keep(&net, Reachability, &["k"]), &options);
    assert_eq!(body(&reduced), "pl a (2); pl k; tr t a*4 -> k; tr u k -> a");

    let net = self::net(&text.replace("a (1)", "a (4)").replace("c*2", "c*3"));
    let reduced = reduce_with(&net, &keep(&net, Deadlock, &["k"]), &options);
    assert_eq!(body(&reduced), "pl a (5); pl k; tr ab a?1 ->; tr t a*5 -> k; tr u k -> a");
    // The token of b is needed where it is, so three of the four tokens of a go to c.
    let lifted = names(&net, &reduced.lift(&run(&reduced, "t u")).unwrap());
    assert_eq!(lifted, "ab bc ab bc ab bc t u");
}

#[test]
fn what_can_be_filled_at_will_goes() {
    let net = net("pl g (1)\npl a (1)\ntr s g?1 -> b*2\ntr t a b*3 -> k\ntr u k b -> a");
    let options = Options { rules: vec![Rule::Supply], ..Options::default() };
    let reduced = reduce_with(&net, &keep(&net, Reachability, &["k"]), &options);
    let text = tina::write(&reduced.net);
    assert_eq!(
        text.lines().skip(1).collect::<Vec<_>>(),
        ["pl g (1)", "pl a (1)", "pl k", "tr t a -> k", "tr u k -> a"]
    );
    // Seven tokens are needed, which come in twos.
    assert_eq!(names(&net, &reduced.lift(&run(&reduced, "t u t")).unwrap()), "s s s s t u t");
}

#[test]
fn what_is_no_run_is_not_lifted() {
    let net = net("pl a (1)\ntr t a -> b\ntr u b -> c");
    let reduced = reduce(&net, &keep(&net, Reachability, &["a", "b", "c"]));
    assert_eq!(reduced.lift(&run(&reduced, "t u u")), Err(LiftError::NoRun(2)));
    assert_eq!(reduced.lift(&[TransitionId::at(7)]), Err(LiftError::NoRun(0)));
}

/// Each place doubles what comes from the one before it.
#[test]
fn runs_too_long_to_write_down_are_not_lifted() {
    let mut builder = Builder::new("doubling");
    let places: Vec<PlaceId> = (0..40).map(|i| builder.place_with(format!("p{i}"), u64::from(i == 0))).collect();
    for (i, pair) in places.windows(2).enumerate() {
        builder.weighted(format!("t{i}"), &[(pair[0], 1)], &[(pair[1], 2)], &[]);
    }
    let last = builder.place_with("last", 0);
    builder.weighted("end", &[(places[39], 1 << 39)], &[(last, 1)], &[]);
    let net = builder.build();
    let reduced = reduce(&net, &keep(&net, Reachability, &["last"]));
    let run: Vec<TransitionId> = reduced.net.transition_ids().collect();
    match reduced.lift(&run) {
        Ok(lifted) => panic!("{} firings", lifted.len()),
        Err(error) => assert!(matches!(error, LiftError::TooLong(_) | LiftError::NoRun(_)), "{error}"),
    }
}

/// A hundred thousand places and as many transitions: in a row, around a hub, as a fan.
#[test]
fn large_nets_are_reduced_in_time() {
    const MANY: usize = 100_000;
    /// Takes the positions of a transition's preset and postset.
    fn large(name: &str, arcs: impl Iterator<Item = (Vec<usize>, Vec<usize>)>) -> Net {
        let mut builder = Builder::new(name);
        let places: Vec<PlaceId> = (0..=MANY).map(|i| builder.place_with(format!("p{i}"), u64::from(i == 0))).collect();
        for (i, (pre, post)) in arcs.enumerate() {
            let [pre, post] = [pre, post].map(|side| side.into_iter().map(|i| (places[i], 1)).collect::<Vec<_>>());
            builder.weighted(format!("t{i}"), &pre, &post, &[]);
        }
        builder.build()
    }
    let nets = [
        large("row", (0..MANY).map(|i| (vec![i], vec![i + 1]))),
        large("ring", (0..=MANY).map(|i| (vec![i], vec![(i + 1) % MANY]))),
        large("hub", (1..MANY).map(|i| (vec![0, i], vec![0, i + 1])).chain([(vec![0], vec![0, 1])])),
        large("star", (1..=MANY).flat_map(|i| [(vec![0], vec![i]), (vec![i], vec![0])])),
        large("fan", (2..=MANY).map(|i| (vec![1], vec![i])).chain([(vec![0], vec![1])])),
        large(
            "row and fan",
            (0..=MANY / 2)
                .map(|i| (vec![i], vec![i + 1]))
                .chain((MANY / 2..MANY).map(|i| (vec![MANY / 2], vec![i + 1]))),
        ),
    ];
    for net in nets {
        for property in [Reachability, Deadlock, Paths] {
            // The star gives and takes the tokens of the place in its middle.
            let kept: &[&str] = if net.name() == "star" { &[] } else { &["p0"] };
            let reduced = reduce(&net, &keep(&net, property, kept));
            let size = Size::of(&reduced.net);
            let is_small = size.places <= 3 && size.transitions <= 3;
            assert!(property == Paths || is_small, "{}: {size:?} {:?}", net.name(), reduced.applied);
            let tokens = reduced.net.initial_tokens();
            let run = reduced.net.transition_ids().find(|&id| reduced.net.has_concession(&tokens, id));
            let run: Vec<TransitionId> = run.into_iter().collect();
            let lifted = reduced.lift(&run);
            assert!(lifted.is_ok(), "{}: {lifted:?}", net.name());
        }
    }
}
