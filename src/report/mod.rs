//! Reports: what was found, as text, pictures and data. Everything here is text or bytes; who writes them where is decided above.

mod listing;
mod table;

pub use listing::{Listing, describe_robot};
pub use table::{Align, Table};
