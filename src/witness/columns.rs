//! Which variables of a run are shown, and in which order.

use std::collections::BTreeSet;

use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};

/// Columns up to which a table is taken in at a glance, so that they stay in the order of the program.
const FEW: usize = 8;

/// The variables of a run that are shown, in groups.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// The groups: in a wide table those that the requirement speaks of, then inputs, memory and outputs.
    pub groups: Vec<Vec<VarId>>,
    /// Number of variables that are not shown.
    pub hidden: usize,
}

impl Columns {
    /// Those that the program declares, without what is local to instances of function blocks; of these only the ones that are
    /// `wanted`, which the requirement speaks of. Where there are many, the wanted ones come first.
    #[must_use]
    pub fn declared(program: &FlatProgram, wanted: &BTreeSet<VarId>) -> Self {
        let is_shown = |id: VarId| !program.internal.contains(&id) || wanted.contains(&id);
        let all = Self::chosen(program, &is_shown);
        if all.iter().count() <= FEW {
            return all;
        }
        let (first, rest) = (|id: &VarId| wanted.contains(id), |id: &VarId| !wanted.contains(id));
        let of = |group: &Vec<VarId>, part: &dyn Fn(&VarId) -> bool| -> Vec<VarId> {
            group.iter().copied().filter(|id| part(id)).collect()
        };
        let front: Vec<VarId> = all.groups.iter().flat_map(|group| of(group, &first)).collect();
        let others = all.groups.iter().map(|group| of(group, &rest));
        Self { groups: std::iter::once(front).chain(others).filter(|group| !group.is_empty()).collect(), ..all }
    }

    /// Inputs, memory and outputs that `is_shown` accepts, in the order of the program.
    #[must_use]
    pub fn chosen(program: &FlatProgram, is_shown: &dyn Fn(VarId) -> bool) -> Self {
        let groups = [Role::Input, Role::Memory, Role::Output].map(|role| program.with_role(role).collect::<Vec<_>>());
        let all = groups.iter().map(Vec::len).sum::<usize>();
        let shown = groups.map(|group| group.into_iter().filter(|&id| is_shown(id)).collect::<Vec<_>>());
        let groups: Vec<Vec<VarId>> = shown.into_iter().filter(|group| !group.is_empty()).collect();
        let hidden = all - groups.iter().map(Vec::len).sum::<usize>();
        Self { groups, hidden }
    }

    /// All variables that are shown, in their order.
    pub fn iter(&self) -> impl Iterator<Item = VarId> {
        self.groups.iter().flatten().copied()
    }
}
