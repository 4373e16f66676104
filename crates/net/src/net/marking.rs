//! Markings of safe nets and the firing rule, exactly as defined.
//!
//! Searches use packed states of their own and are checked against these.

use fixedbitset::FixedBitSet;

use super::{Net, PlaceId, TransitionId};

/// A marking of a safe net: the set of marked places.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Marking(FixedBitSet);

impl Marking {
    /// Whether a place is marked.
    #[must_use]
    pub fn is_marked(&self, place: PlaceId) -> bool {
        self.0.contains(place.index())
    }

    /// Marks a place, or removes its token.
    pub fn put(&mut self, place: PlaceId, is_marked: bool) {
        self.0.set(place.index(), is_marked);
    }

    /// The marked places, in ascending order.
    pub fn marked(&self) -> impl Iterator<Item = PlaceId> {
        self.0.ones().map(PlaceId::at)
    }
}

/// Error: firing would put a second token on the place, so the net is not safe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotSafe(pub PlaceId);

impl Net {
    /// The initial marking.
    #[must_use]
    pub fn initial_marking(&self) -> Marking {
        let mut marking = FixedBitSet::with_capacity(self.places().len());
        for id in self.place_ids().filter(|&id| self.place(id).is_marked()) {
            marking.insert(id.index());
        }
        Marking(marking)
    }

    /// Whether a transition is enabled: all places of its preset, read places included, are marked.
    #[must_use]
    pub fn is_enabled(&self, marking: &Marking, transition: TransitionId) -> bool {
        self.arcs(transition).preset().all(|place| marking.is_marked(place))
    }

    /// The enabled transitions, in ascending order.
    pub fn enabled(&self, marking: &Marking) -> impl Iterator<Item = TransitionId> {
        self.transition_ids().filter(|&transition| self.is_enabled(marking, transition))
    }

    /// Fires an enabled transition.
    ///
    /// # Errors
    /// [`NotSafe`] if a place of the postset would get a second token; the marking is then left as it was.
    pub fn fire(&self, marking: &mut Marking, transition: TransitionId) -> Result<(), NotSafe> {
        debug_assert!(self.is_enabled(marking, transition), "{} is not enabled", self.transition(transition).name);
        let arcs = self.arcs(transition);
        // The builder keeps preset and postset apart, so a marked place of the postset does not lose its token first.
        if let Some(&place) = arcs.produce.iter().find(|&&place| marking.is_marked(place)) {
            return Err(NotSafe(place));
        }
        arcs.consume.iter().for_each(|place| marking.0.remove(place.index()));
        arcs.produce.iter().for_each(|place| marking.0.insert(place.index()));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::net::{Arcs, Builder, NotSafe};

    #[test]
    fn loops_become_read_arcs_and_read_tokens_stay() {
        let mut builder = Builder::new("n");
        let [a, b, c] = ["a", "b", "c"].map(|name| builder.place(name, name == "a"));
        let t = builder.transition("t", Arcs { consume: &[a], produce: &[b, a], read: &[] });
        let u = builder.transition("u", Arcs { consume: &[b], produce: &[c], read: &[a, b] });
        let net = builder.build();
        assert_eq!(net.arcs(t), Arcs { consume: &[], produce: &[b], read: &[a] });
        assert_eq!(net.arcs(u), Arcs { consume: &[b], produce: &[c], read: &[a] });
        assert_eq!((net.arc_count(), net.read_arc_count()), (7, 2));

        let mut marking = net.initial_marking();
        assert_eq!(net.enabled(&marking).collect::<Vec<_>>(), [t]);
        net.fire(&mut marking, t).unwrap();
        assert_eq!(marking.marked().collect::<Vec<_>>(), [a, b]);
        assert_eq!(net.fire(&mut marking, t), Err(NotSafe(b)));
        net.fire(&mut marking, u).unwrap();
        assert_eq!(marking.marked().collect::<Vec<_>>(), [a, c]);
    }

    #[test]
    fn putting_a_token_where_one_is_read_is_not_safe() {
        let mut builder = Builder::new("n");
        let a = builder.place("a", true);
        let t = builder.transition("t", Arcs { consume: &[], produce: &[a], read: &[a] });
        let net = builder.build();
        assert_eq!(net.fire(&mut net.initial_marking(), t), Err(NotSafe(a)));
    }
}
