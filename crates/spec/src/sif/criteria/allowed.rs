//! Sets of allowed and of triggering valuations, as decision diagrams.

use super::super::cone::Cone;
use super::super::diagram::{Diagram, Diagrams};
use super::super::formula::SignalId;
use super::Limits;

/// Sets of valuations of the varied inputs. All other inputs are FALSE in them, whatever their values have to be.
pub struct Allowed {
    /// Manager of the diagrams.
    pub diagrams: Diagrams,
    /// Allowed valuations.
    pub allowed: Diagram,
    /// Triggering valuations (an output is TRUE), allowed or not.
    pub triggering: Diagram,
    /// For each restriction of the cone: the valuations it excludes, whatever the other inputs are; and those allowed
    /// without it.
    pub restrictions: Vec<(Diagram, Diagram)>,
    /// Valuations with all other inputs FALSE.
    plain: Diagram,
    connected: Vec<SignalId>,
}

impl Allowed {
    /// Computes the sets for a cone and its outputs; `None` if a diagram becomes too large.
    pub fn of(cone: &Cone<'_>, outputs: &[SignalId], limits: &Limits, with_restrictions: bool) -> Option<Self> {
        let specification = cone.specification;
        let diagrams = Diagrams::over(cone.all_inputs().collect(), specification.signals.len(), limits.nodes)?;
        let mut of: Vec<Option<Diagram>> = vec![None; specification.signals.len()];
        for input in cone.all_inputs() {
            of[input.0] = diagrams.signal(input);
        }
        for id in &cone.definitions {
            if (limits.stop)() {
                return None;
            }
            let formula = specification.definition(*id)?;
            of[id.0] = Some(diagrams.formula(formula, &|signal| of[signal.0].clone())?);
        }
        let mut triggering = diagrams.constant(false);
        for output in outputs {
            triggering = diagrams.or(&triggering, of[output.0].as_ref()?)?;
        }
        let mut kept = Vec::new();
        for restriction in &cone.restrictions {
            if (limits.stop)() {
                return None;
            }
            kept.push(diagrams.formula(&restriction.allowed, &|signal| of[signal.0].clone())?);
        }
        let mut plain = diagrams.constant(true);
        for input in &cone.connected {
            plain = diagrams.and(&plain, &diagrams.signal(*input)?.complement())?;
        }
        let nothing = diagrams.constant(false);
        let connected = cone.connected.clone();
        let mut sets = Self {
            diagrams,
            allowed: nothing.clone(),
            triggering: nothing,
            restrictions: Vec::new(),
            plain,
            connected,
        };
        sets.allowed = sets.narrow(&sets.all(&kept, None)?)?;
        sets.triggering = sets.diagrams.and(&triggering, &sets.plain)?;
        if with_restrictions {
            for (position, restriction) in kept.iter().enumerate() {
                let excluded = sets.diagrams.and(&sets.narrow(restriction)?.complement(), &sets.plain)?;
                let without = sets.narrow(&sets.all(&kept, Some(position))?)?;
                sets.restrictions.push((excluded, without));
            }
        }
        Some(sets)
    }

    /// Intersection of all sets but one.
    fn all(&self, sets: &[Diagram], without: Option<usize>) -> Option<Diagram> {
        let sets = sets.iter().enumerate().filter(|(position, _)| Some(*position) != without);
        sets.map(|(_, set)| set).try_fold(self.diagrams.constant(true), |all, set| self.diagrams.and(&all, set))
    }

    /// Existential projection of a set onto the varied inputs.
    fn narrow(&self, set: &Diagram) -> Option<Diagram> {
        self.diagrams.and(&self.diagrams.whatever(set, &self.connected)?, &self.plain)
    }

    /// Allowed valuations or, if wanted, those that make an output TRUE.
    pub fn tests(&self, only_triggering: bool) -> Option<Diagram> {
        if only_triggering { self.diagrams.and(&self.allowed, &self.triggering) } else { Some(self.allowed.clone()) }
    }
}
