//! Names and the order of entities, and access to their components.

use hecs::{Component, Entity, Query, World};

/// Values of the entities that a query finds, in file order.
pub fn in_file_order<Q: Query, T>(
    world: &World,
    value: impl for<'a> Fn(Q::Item<'a>) -> T,
) -> Vec<T> {
    let mut query = world.query::<(&FileOrder, Q)>();
    let with_order = query.iter().map(|(order, it)| (*order, Some(value(it))));
    let mut values: Vec<_> = with_order.collect();
    // Places are sorted in place of values, so that one sort is compiled for all types.
    let mut places: Vec<_> = values.iter().map(|it| it.0).zip(0_usize..).collect();
    places.sort_unstable();
    let sorted = places.into_iter();
    sorted.filter_map(|it| values[it.1].1.take()).collect()
}

/// The entities that have a component, in file order.
pub fn ordered<C: Component>(world: &World) -> Vec<Entity> {
    in_file_order::<(Entity, &C), _>(world, |(entity, _)| entity)
}

/// The names of the entities that have a component, in file order.
pub fn names<C: Component>(world: &World) -> Vec<String> {
    in_file_order::<(&Name, &C), _>(world, |(name, _)| name.0.clone())
}

/// A copy of a component; `None` if the entity has no such component.
pub fn get<C: Component + Clone>(world: &World, entity: Entity) -> Option<C> {
    world.get::<&C>(entity).ok().as_deref().cloned()
}

/// The value that a component has in all entities; `None` if they differ, or if there is none.
pub fn common<C: Component + Copy + PartialEq>(world: &World) -> Option<C> {
    alike(world.query::<&C>().iter().copied())
}

/// The value that all of these are; `None` if they differ, or if there is none.
pub fn alike<C: PartialEq>(values: impl IntoIterator<Item = C>) -> Option<C> {
    let mut values = values.into_iter();
    let first = values.next()?;
    values.all(|value| value == first).then_some(first)
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
