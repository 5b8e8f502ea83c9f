//! shadetrade
fn main() {}
