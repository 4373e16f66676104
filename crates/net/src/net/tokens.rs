//! Markings of any place/transition net and the firing rule, exactly as defined.
//!
//! Searches use packed states of their own and are checked against these.

use super::{Net, PlaceId, TransitionId};

/// A marking: the number of tokens on each place.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Tokens(Vec<u64>);

impl Tokens {
    /// Number of tokens on a place.
    #[must_use]
    pub fn on(&self, place: PlaceId) -> u64 {
        self.0[place.index()]
    }

    /// Number of tokens on every place, by position.
    #[must_use]
    pub fn as_slice(&self) -> &[u64] {
        &self.0
    }
}

/// Error: firing would put more than 2^64 - 1 tokens on the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overflow(pub PlaceId);

impl Net {
    /// The initial marking.
    #[must_use]
    pub fn initial_tokens(&self) -> Tokens {
        Tokens(self.places().map(|place| place.tokens).collect())
    }

    /// Whether a transition is enabled: each place of its preset has at least as many tokens as the arc's weight.
    #[must_use]
    pub fn has_concession(&self, tokens: &Tokens, transition: TransitionId) -> bool {
        self.pre(transition).all(|(place, weight)| tokens.on(place) >= weight)
    }

    /// Fires an enabled transition.
    ///
    /// # Errors
    /// [`Overflow`] if a place would get more than 2^64 - 1 tokens; the marking is then left as it was.
    pub fn play(&self, tokens: &mut Tokens, transition: TransitionId) -> Result<(), Overflow> {
        debug_assert!(self.has_concession(tokens, transition), "{} is not enabled", self.transition(transition).name);
        let mut next = tokens.clone();
        self.pre(transition).for_each(|(place, weight)| next.0[place.index()] -= weight);
        for (place, weight) in self.post(transition) {
            let on = &mut next.0[place.index()];
            *on = on.checked_add(weight).ok_or(Overflow(place))?;
        }
        *tokens = next;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::net::{Builder, PlaceId};

    #[test]
    fn weights_are_taken_and_put() {
        let mut builder = Builder::new("n");
        let [a, b] = [("a", 5), ("b", 0)].map(|(name, tokens)| builder.place_with(name, tokens));
        let t = builder.weighted("t", &[(a, 3)], &[(a, 1), (b, 2)], &[]);
        let u = builder.weighted("u", &[(b, 1), (b, 1)], &[], &[(a, 2)]);
        let net = builder.build();
        assert_eq!(net.arc_count(), 6);
        let pairs = |list: Vec<(PlaceId, u64)>| list.into_iter().map(|(p, w)| (p.index(), w)).collect::<Vec<_>>();
        assert_eq!(pairs(net.pre(t).collect()), [(0, 3)]);
        assert_eq!(pairs(net.post(t).collect()), [(0, 1), (1, 2)]);
        assert_eq!(pairs(net.pre(u).collect()), [(0, 2), (1, 2)]);
        assert_eq!(pairs(net.post(u).collect()), [(0, 2)]);

        let mut tokens = net.initial_tokens();
        assert!(net.has_concession(&tokens, t) && !net.has_concession(&tokens, u));
        net.play(&mut tokens, t).unwrap();
        assert_eq!(tokens.as_slice(), [3, 2]);
        net.play(&mut tokens, u).unwrap();
        assert_eq!(tokens.as_slice(), [3, 0]);
        net.play(&mut tokens, t).unwrap();
        assert_eq!(tokens.as_slice(), [1, 2]);
        assert!(!net.has_concession(&tokens, t) && !net.has_concession(&tokens, u), "u reads two tokens");
    }
}
