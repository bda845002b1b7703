//! How much memory lists take, as allocators give it.

/// What an allocator needs for itself, and the least it gives.
const OVERHEAD: usize = 8;
const LEAST: usize = 24;

/// Bytes that the elements of a list hold outside of it, not counting what these hold in turn.
pub(crate) fn held<T>(list: &[T]) -> usize {
    match std::mem::size_of_val(list) {
        0 => 0,
        size => OVERHEAD + size.max(LEAST),
    }
}
