//! Assumptions about the inputs of a scan, as the exploration asks them.

use petril_base::VarId;

/// Says which scans can begin: what inputs do not do is not explored.
pub trait Admission: Sync {
    /// Whether a scan may begin with these inputs. `before` gives the values of variables at the end of the scan before, `now` those
    /// of the inputs that are read.
    fn admits(&self, before: &dyn Fn(VarId) -> u64, now: &dyn Fn(VarId) -> u64) -> bool;
    /// The variables whose values before make a difference.
    fn recalls(&self) -> Vec<VarId>;
}
