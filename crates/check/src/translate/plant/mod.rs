//! Plant: ordinary safe nets around the program.
//!
//! A place named by a valuation of inputs, like `S1=1,O1=0`, gives these inputs their external values while it is
//! marked. A place named by a valuation of outputs is the program's own place (a logical place in the seed paper's
//! sense): the plant's transitions may read it, and so react to the outputs of the program. Every connected component
//! of a plant net is a device that moves independently of the others; the PLC stops and frees each through a blocking
//! place.

mod component;
mod doubts;
mod markings;
mod read;

pub use component::{Component, LocalMarking, Move, PlantPlace, PlantTransition};

use petril_base::diagnostic::Diagnostic;
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::VarId;
use petril_net::net::Located;

/// Devices around a program.
#[derive(Clone, Debug, Default)]
pub struct Plant {
    /// Devices, in the order they were added.
    pub components: Vec<Component>,
    /// Names of the nets that the devices come from.
    names: Vec<String>,
}

impl Plant {
    /// Adds the devices of a net, and returns warnings about them.
    ///
    /// # Errors
    /// Every reason why the net is not a plant of this program: unknown variables, a net that is not safe, inputs with
    /// no value or
    /// several. Nothing is added then.
    pub fn add(&mut self, net: &Located, program: &FlatProgram) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        let devices = read::devices(net, program, self)?;
        let warnings = doubts::warnings(net, &devices);
        self.components.extend(devices.into_iter().map(|device| device.component));
        self.names.push(net.net.name().to_owned());
        Ok(warnings)
    }

    /// Position of the component that drives an input, if there is one.
    #[must_use]
    pub fn driver(&self, input: VarId) -> Option<usize> {
        self.components.iter().position(|component| component.drives(input))
    }

    /// Outputs that the plant reads.
    pub fn tested(&self) -> impl Iterator<Item = VarId> {
        let transitions = self.components.iter().flat_map(|component| &component.transitions);
        transitions.flat_map(|transition| &transition.tests).map(|&(output, _)| output)
    }

    /// Names of the nets, in the order they were added.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }
}
