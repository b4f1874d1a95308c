//! Oracles and shared parts of the tests and measuring commands.

pub mod oracle;
