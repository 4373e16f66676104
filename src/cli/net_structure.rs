//! Structure of a net as text and as JSON.

use std::fmt::Write as _;

use petril::net::{Net, PlaceId, TransitionId};
use petril::structure::{Commoner, Invariants, Siphons, Summary};
use serde_json::{Map, Value, json};

use super::args::NetInfo;
use super::net_info::{NAMED, named};
use super::report::counted;

/// Structure of a net, with the options of its output.
pub struct Structure<'a> {
    pub net: &'a Net,
    pub summary: &'a Summary,
    pub arguments: &'a NetInfo,
}

impl Structure<'_> {
    /// Summary with one line per fact.
    pub fn text(&self) -> String {
        let summary = self.summary;
        let (places, transitions) = (self.net.places().len(), self.net.transitions().len());
        let mut out = format!("class        {}\n", self.classes().join(", "));
        let _ = writeln!(out, "connected    {}", self.connected());
        let cover = |is_covered: Option<bool>, yes: &str, no: &str| match is_covered {
            Some(true) => format!("; {yes}"),
            Some(false) => format!("; {no}"),
            None => String::new(),
        };
        let _ = writeln!(
            out,
            "P-invariants {}{}",
            self.invariants(&summary.place_invariants, places),
            cover(summary.is_conservative(), "each place is in one: conservative", "not every place is in one"),
        );
        let _ = writeln!(
            out,
            "T-invariants {}{}",
            self.invariants(&summary.transition_invariants, transitions),
            cover(
                summary.is_consistent(self.net),
                "each transition is in one: consistent",
                "not every transition is in one"
            ),
        );
        let _ = writeln!(out, "bounds       {}", self.bounds());
        let trapped = match &summary.commoner {
            _ if summary.siphons.found.is_empty() => String::new(),
            Commoner::Holds => "; each holds a trap that is marked initially".to_owned(),
            Commoner::Fails(siphon) if siphon.len() > NAMED => {
                let first = self.places(&siphon[..NAMED]).join(", ");
                format!("; {{{first}, …}}, {} places, holds no trap that is marked initially", siphon.len())
            }
            Commoner::Fails(siphon) => format!("; {} holds no trap that is marked initially", self.set(siphon)),
            Commoner::Unknown => "; each of these holds a trap that is marked initially".to_owned(),
        };
        let _ = writeln!(out, "siphons      {}{trapped}", found(&summary.siphons));
        let _ = writeln!(out, "traps        {}", found(&summary.traps));
        let follows = self.follows();
        if !follows.is_empty() {
            let _ = writeln!(out, "so           {}", follows.join(", "));
        }
        out
    }

    /// Requested lists of invariants, siphons and traps.
    pub fn lists(&self) -> String {
        let mut out = String::new();
        let summary = self.summary;
        if self.arguments.invariants {
            out += "\nplace invariants\n";
            for one in &summary.place_invariants.found {
                let sum = sum(one.weights.iter().map(|&(place, weight)| (self.net.place(place).name, weight)));
                let _ = writeln!(out, "    {sum} = {}", one.tokens);
            }
            out += "\ntransition invariants\n";
            for one in &summary.transition_invariants.found {
                let sum = sum(one.firings.iter().map(|&(id, times)| (self.net.transition(id).name, times)));
                let _ = writeln!(out, "    {sum}");
            }
        }
        for (is_wanted, title, sets) in
            [(self.arguments.siphons, "siphons", &summary.siphons), (self.arguments.traps, "traps", &summary.traps)]
        {
            if is_wanted {
                let _ = writeln!(out, "\nminimal {title}");
                sets.found.iter().for_each(|places| _ = writeln!(out, "    {}", self.set(places)));
            }
        }
        out
    }

    /// Data as a JSON object.
    pub fn json(&self) -> Value {
        let summary = self.summary;
        let class = &summary.class;
        let mut document = json!({
            "ordinary": class.ordinary,
            "pure": class.pure,
            "state_machine": class.state_machine,
            "marked_graph": class.marked_graph,
            "free_choice": class.free_choice,
            "extended_free_choice": class.extended_free_choice,
            "keeps_tokens": class.keeps_tokens,
            "weakly_connected_components": summary.components.weakly,
            "strongly_connected_components": summary.components.strongly,
            "rank": summary.rank,
            "place_invariants": summary.place_invariants.found.len(),
            "all_place_invariants": summary.place_invariants.all,
            "conservative": summary.is_conservative(),
            "transition_invariants": summary.transition_invariants.found.len(),
            "all_transition_invariants": summary.transition_invariants.all,
            "consistent": summary.is_consistent(self.net),
            "bound_in_place": summary.most_in_place(),
            "bound_in_marking": summary.bound.as_ref().map(|bound| bound.most),
            "siphons": summary.siphons.found.len(),
            "all_siphons": summary.siphons.all,
            "traps": summary.traps.found.len(),
            "all_traps": summary.traps.all,
            "siphons_hold_marked_traps": match summary.commoner {
                Commoner::Holds => Some(true),
                Commoner::Fails(_) => Some(false),
                Commoner::Unknown => None,
            },
            "no_deadlock": summary.excludes_deadlock.then_some(true),
            "live": summary.is_live,
            "starved_transitions": self.transitions(&summary.starved),
        });
        let map = |pairs: &mut dyn Iterator<Item = (&str, u64)>| -> Map<String, Value> {
            pairs.map(|(name, weight)| (name.to_owned(), weight.into())).collect()
        };
        if self.arguments.invariants {
            let places = summary.place_invariants.found.iter().map(|one| {
                let weights = map(&mut one.weights.iter().map(|&(place, weight)| (self.net.place(place).name, weight)));
                json!({ "weights": weights, "tokens": one.tokens })
            });
            document["found_place_invariants"] = places.collect();
            let transitions = summary
                .transition_invariants
                .found
                .iter()
                .map(|one| map(&mut one.firings.iter().map(|&(id, times)| (self.net.transition(id).name, times))));
            document["found_transition_invariants"] = transitions.collect();
        }
        let sets = |sets: &Siphons| sets.found.iter().map(|places| json!(self.places(places))).collect::<Value>();
        if self.arguments.siphons {
            document["found_siphons"] = sets(&summary.siphons);
        }
        if self.arguments.traps {
            document["found_traps"] = sets(&summary.traps);
        }
        document
    }

    fn classes(&self) -> Vec<&'static str> {
        let class = &self.summary.class;
        let choice = match (class.free_choice, class.extended_free_choice) {
            (true, _) => "free choice",
            (_, true) => "extended free choice",
            _ => "choice not free",
        };
        let mut names = vec![if class.ordinary { "ordinary" } else { "with weights" }];
        names.extend(class.ordinary.then_some(choice));
        names.push(if class.pure { "pure" } else { "with loops" });
        names.extend(class.state_machine.then_some("state machine"));
        names.extend(class.marked_graph.then_some("marked graph"));
        names.extend(class.keeps_tokens.then_some("no firing changes the number of tokens"));
        names
    }

    fn connected(&self) -> String {
        match (self.summary.components.weakly, self.summary.components.strongly) {
            (0, _) => "there is nothing".to_owned(),
            (1, 1) => "strongly".to_owned(),
            (1, strongly) => format!("weakly, {strongly} strongly connected components"),
            (weakly, strongly) if weakly == strongly => format!("no, {weakly} parts, each strongly"),
            (weakly, strongly) => format!("no, {weakly} parts with {strongly} strongly connected components"),
        }
    }

    /// Number of invariants of a net with this number of nodes.
    fn invariants<I>(&self, invariants: &Invariants<I>, nodes: usize) -> String {
        let count = invariants.found.len();
        let mut out = if invariants.all {
            format!("{count} minimal")
        } else {
            format!("not all computed (more steps than --effort allows), {count} found")
        };
        if let Some(rank) = self.summary.rank {
            let _ = write!(out, ", {} independent", nodes - rank);
        }
        out
    }

    fn bounds(&self) -> String {
        let place = match self.summary.most_in_place() {
            Some(0) => "no place ever has a token".to_owned(),
            Some(1) => "1 token in a place by invariants: safe".to_owned(),
            Some(most) => format!("{most} tokens in a place by invariants"),
            None => {
                let without = self.summary.place_bounds.iter().filter(|bound| bound.is_none()).count();
                format!("invariants limit all places but {without}")
            }
        };
        let marking = match &self.summary.bound {
            Some(bound) => format!("{} in a marking by the state equation", bound.most),
            None => "none in a marking is known".to_owned(),
        };
        format!("{place}; {marking}")
    }

    /// Consequences of siphons and traps for behaviour.
    fn follows(&self) -> Vec<String> {
        let mut follows = Vec::new();
        follows.extend(self.summary.is_live.map(|live| if live { "live" } else { "not live" }.to_owned()));
        follows.extend(self.summary.excludes_deadlock.then(|| "no deadlock".to_owned()));
        let starved = self.transitions(&self.summary.starved);
        if !starved.is_empty() {
            let count = counted(starved.len(), "transition");
            follows.push(format!("{count} dead, for want of tokens of an empty siphon{}", named(&starved)));
        }
        follows
    }

    fn transitions(&self, ids: &[TransitionId]) -> Vec<&str> {
        ids.iter().map(|&id| self.net.transition(id).name).collect()
    }

    fn places(&self, ids: &[PlaceId]) -> Vec<&str> {
        ids.iter().map(|&id| self.net.place(id).name).collect()
    }

    fn set(&self, places: &[PlaceId]) -> String {
        format!("{{{}}}", self.places(places).join(", "))
    }
}

fn found(sets: &Siphons) -> String {
    let count = sets.found.len();
    if sets.all {
        format!("{count} minimal")
    } else {
        format!("not all computed (more sets or steps than --effort allows), {count} minimal ones found")
    }
}

/// A sum such as `a + 2 b`.
fn sum<'n>(terms: impl Iterator<Item = (&'n str, u64)>) -> String {
    let term = |(name, times): (&str, u64)| if times == 1 { name.to_owned() } else { format!("{times} {name}") };
    terms.map(term).collect::<Vec<_>>().join(" + ")
}
