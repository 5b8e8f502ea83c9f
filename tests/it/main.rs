//! Every test that needs no display, as one program, so that the crate is linked once.

mod blinn;
mod cameras;
mod certificate;

mod cli;
mod extremes;
mod flat;
mod golden;
mod layers;
mod lessons;
mod probe;
mod prove;
mod rasterization;
mod reference;
mod requires;
mod scene;
mod shading;
mod stability;
mod support;
mod systems;
mod trade;
mod vary;
mod window;
