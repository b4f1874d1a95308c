//! Oracles and shared parts of the tests and measuring commands.

pub mod accuracy;
pub mod boards;
pub mod cross;
pub mod dump;
pub mod measure;
pub mod mesh;
pub mod oracle;
pub mod record;
pub mod snapped;
pub mod trade;
