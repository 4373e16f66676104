//! Textual format of the TINA toolbox (`.net`): one declaration per line.
//!
//! ```
//! use petril_base::source::Source;
//! use petril_net::format::tina;
//!
//! let source = Source::new("lamp.net", "tr switch off -> on\npl off (1)\n");
//! let lamp = tina::read(&source).expect("well written");
//! assert_eq!(lamp.net.name(), "lamp");
//! assert_eq!(tina::write(&lamp.net), "net lamp\npl off (1)\npl on\ntr switch off -> on\n");
//! ```
//!
//! A name in braces may contain any characters; the braces are quotes, so the name of `{S1=0}` is `S1=0`.

mod consume;
mod expected;
mod read;
mod write;

#[cfg(test)]
mod tests;

pub use read::{read, read_safe};
pub use write::{write, write_to};
