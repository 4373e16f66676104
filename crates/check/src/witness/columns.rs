//! Columns of a run's table: which variables are shown, and in which order.

use std::collections::BTreeSet;

use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};

/// Upper bound on columns that are taken in at a glance and therefore stay in the order of the program.
const FEW: usize = 8;

/// Variables shown of a run, in groups.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// Groups of columns: in a wide table first the variables the requirement mentions, then inputs, memory and
    /// outputs.
    pub groups: Vec<Vec<VarId>>,
    /// Number of variables not shown.
    pub hidden: usize,
}

impl Columns {
    /// Variables declared by the program. Variables local to function block instances are included only if `wanted`
    /// (mentioned by the requirement). In a wide table the wanted ones come first.
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

    /// Inputs, memory and outputs accepted by `is_shown`, in the order of the program.
    #[must_use]
    pub fn chosen(program: &FlatProgram, is_shown: &dyn Fn(VarId) -> bool) -> Self {
        let groups = [Role::Input, Role::Memory, Role::Output].map(|role| program.with_role(role).collect::<Vec<_>>());
        let all = groups.iter().map(Vec::len).sum::<usize>();
        let shown = groups.map(|group| group.into_iter().filter(|&id| is_shown(id)).collect::<Vec<_>>());
        let groups: Vec<Vec<VarId>> = shown.into_iter().filter(|group| !group.is_empty()).collect();
        let hidden = all - groups.iter().map(Vec::len).sum::<usize>();
        Self { groups, hidden }
    }

    /// Variables shown, in column order.
    pub fn iter(&self) -> impl Iterator<Item = VarId> {
        self.groups.iter().flatten().copied()
    }
}
