//! The only place where pointers of C are followed.

use core::slice;

/// Whether a `T` fits into the room that C has for it.
pub(crate) const fn fits_in<T, Room>() -> bool {
    size_of::<T>() <= size_of::<Room>() && align_of::<T>() <= align_of::<Room>()
}

/// What a pointer of C points to; `None` if it is null or misaligned.
///
/// # Safety
/// Any other pointer is one to a whole `T` that nobody writes to during the call. `T` is plain numbers, of which every bit
/// pattern is valid.
pub(crate) unsafe fn read<T: Copy>(pointer: *const T) -> Option<T> {
    // SAFETY: neither null nor misaligned, and by the contract of this function there is a `T`.
    usable(pointer).then(|| unsafe { pointer.read() })
}

/// The same in its place, for what is large.
///
/// # Safety
/// As for [`read`]; the reference is dropped before the call ends.
pub(crate) unsafe fn follow<'a, T: Copy>(pointer: *const T) -> Option<&'a T> {
    // SAFETY: neither null nor misaligned, and by the contract of this function there is a `T`.
    usable(pointer).then(|| unsafe { &*pointer })
}

/// The same of what is written to.
///
/// # Safety
/// As for [`follow`], and nobody else uses it while there is the reference.
pub(crate) unsafe fn follow_mut<'a, T: Copy>(pointer: *mut T) -> Option<&'a mut T> {
    // SAFETY: neither null nor misaligned, and by the contract of this function there is a `T` for this reference alone.
    usable(pointer).then(|| unsafe { &mut *pointer })
}

/// An array of C; `None` if its pointer is null or misaligned, or if no memory could hold so many.
///
/// # Safety
/// As for [`follow`], of all elements.
pub(crate) unsafe fn slice<'a, T: Copy>(array: *const T, count: usize) -> Option<&'a [T]> {
    let usable = usable(array) && fits::<T>(count);
    // SAFETY: neither null nor misaligned, of a possible size, and by the contract of this function all elements are there.
    usable.then(|| unsafe { slice::from_raw_parts(array, count) })
}

/// Room of C for an array, which holds zeros from then on; `None` as for [`slice`].
///
/// # Safety
/// As for [`write`], of all elements, of which zeros are valid; the reference is dropped before the call ends.
pub(crate) unsafe fn zeroed<'a, T: Copy>(array: *mut T, count: usize) -> Option<&'a mut [T]> {
    let usable = usable(array) && fits::<T>(count);
    usable.then(|| {
        // SAFETY: neither null nor misaligned, of a possible size, and by the contract of this function there is room.
        unsafe {
            array.write_bytes(0, count);
            slice::from_raw_parts_mut(array, count)
        }
    })
}

/// Such an array that is written to.
///
/// # Safety
/// As for [`follow_mut`], of all elements.
pub(crate) unsafe fn slice_mut<'a, T: Copy>(array: *mut T, count: usize) -> Option<&'a mut [T]> {
    let usable = usable(array) && fits::<T>(count);
    // SAFETY: neither null nor misaligned, of a possible size, and by the contract of this function all elements are there.
    usable.then(|| unsafe { slice::from_raw_parts_mut(array, count) })
}

/// Whether there is room for a result; `None` if the pointer to it is null or misaligned.
pub(crate) fn room<T>(pointer: *mut T) -> Option<()> {
    usable(pointer).then_some(())
}

/// Whether a pointer can be followed.
fn usable<T>(pointer: *const T) -> bool {
    !pointer.is_null() && pointer.is_aligned()
}

/// Whether an array of so many elements can be in memory.
fn fits<T>(count: usize) -> bool {
    count.checked_mul(size_of::<T>()).is_some_and(|bytes| bytes <= isize::MAX as usize)
}

/// Writes a result to where C wants it; `None` if that is null or misaligned, and nothing is written.
///
/// # Safety
/// Any other pointer is one to room for a `T`, which nobody else uses during the call; what is there need not be valid.
pub(crate) unsafe fn write<T: Copy>(pointer: *mut T, value: T) -> Option<()> {
    // SAFETY: neither null nor misaligned, and by the contract of this function there is room for a `T`.
    usable(pointer).then(|| unsafe { pointer.write(value) })
}

/// The element of an array of C at an index, as a pointer; null stays null.
pub(crate) fn element<T>(array: *const T, index: usize) -> *const T {
    if array.is_null() { array } else { array.wrapping_add(index) }
}

/// The same of an array that is written to.
pub(crate) fn element_mut<T>(array: *mut T, index: usize) -> *mut T {
    if array.is_null() { array } else { array.wrapping_add(index) }
}
