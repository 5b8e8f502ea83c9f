//! shadetrade draws lit cuboids with Gouraud and Phong shading and measures what every shortcut costs.
pub mod components;
pub mod frame;
pub mod reference;
pub mod scene;
pub mod shading;
pub mod systems;
pub mod trade;
