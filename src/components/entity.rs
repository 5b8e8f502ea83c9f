//! Names and the order of entities, and access to their components.

use hecs::{Component, Entity, World};

/// The entities that have a component, in file order.
pub fn ordered<C: Component>(world: &World) -> Vec<Entity> {
    let mut query = world.query::<(Entity, &FileOrder)>().with::<&C>();
    in_file_order(query.iter().map(|(entity, order)| (*order, entity)))
}

/// Values of entities, in file order.
pub fn in_file_order<T>(entities: impl Iterator<Item = (FileOrder, T)>) -> Vec<T> {
    let mut entities: Vec<_> = entities.collect();
    entities.sort_by_key(|(order, _)| *order);
    entities.into_iter().map(|(_, entity)| entity).collect()
}

/// The names of the entities that have a component, in file order.
pub fn names<C: Component>(world: &World) -> Vec<String> {
    let entities = ordered::<C>(world).into_iter();
    entities
        .filter_map(|entity| get(world, entity).map(|Name(name)| name))
        .collect()
}

/// A copy of a component; `None` if the entity has no such component.
pub fn get<C: Component + Clone>(world: &World, entity: Entity) -> Option<C> {
    world
        .get::<&C>(entity)
        .ok()
        .map(|component| (*component).clone())
}

/// The name in the scene file: not empty, unique within its kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(pub String);

/// The index of a cuboid, a light or a camera among its kind in the scene file. It numbers cuboids, decides ties of depth
/// and orders lists. A removed entity leaves a gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileOrder(pub u32);

/// Overwrites a component of all entities that have it.
pub fn overwrite<C: Component + Clone>(world: &mut World, component: &C) {
    for own in world.query_mut::<&mut C>() {
        *own = component.clone();
    }
}
