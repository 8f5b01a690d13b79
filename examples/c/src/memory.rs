//! The only place where pointers of C are followed.

/// What a pointer of C points to; `None` if it is null or misaligned.
///
/// # Safety
/// Any other pointer is one to a whole `T` that nobody writes to during the call. `T` is plain numbers, of which every bit
/// pattern is valid.
pub(crate) unsafe fn read<T: Copy>(pointer: *const T) -> Option<T> {
    let usable = !pointer.is_null() && pointer.is_aligned();
    // SAFETY: neither null nor misaligned, and by the contract of this function there is a `T`.
    usable.then(|| unsafe { pointer.read() })
}

/// Writes a result to where C wants it; `None` if that is null or misaligned, and nothing is written.
///
/// # Safety
/// Any other pointer is one to room for a `T`, which nobody else uses during the call; what is there need not be valid.
pub(crate) unsafe fn write<T: Copy>(pointer: *mut T, value: T) -> Option<()> {
    let usable = !pointer.is_null() && pointer.is_aligned();
    // SAFETY: neither null nor misaligned, and by the contract of this function there is room for a `T`.
    usable.then(|| unsafe { pointer.write(value) })
}

/// The element of an array of C at an index, as a pointer; null stays null.
pub(crate) fn element<T>(array: *const T, index: usize) -> *const T {
    if array.is_null() { array } else { array.wrapping_add(index) }
}

/// The same of an array that is written to.
pub(crate) fn element_mut<T>(array: *mut T, index: usize) -> *mut T {
    if array.is_null() { array } else { array.wrapping_add(index) }
}
