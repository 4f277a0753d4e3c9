//! What both components have: the journal, their state, and memory for the values of calls.

use core::cell::{Cell, UnsafeCell};

use crate::console::{Console, Log, Stream};
use crate::text::Text;

#[link(wasm_import_module = "wasmouse:robot/journal@0.2.0")]
unsafe extern "C" {
    #[link_name = "log"]
    fn journal_log(level: u32, text: *const u8, bytes: usize);
    #[link_name = "panic"]
    fn journal_panic(text: *const u8, bytes: usize);
}

/// A value of the instance, which has one thread.
pub struct Single<T>(UnsafeCell<T>);

// SAFETY: an instance of a component has one thread.
unsafe impl<T> Sync for Single<T> {}

impl<T> Single<T> {
    pub const fn new(value: T) -> Self {
        Self(UnsafeCell::new(value))
    }

    /// Lends the value. What it is lent to must not call this again for the same value.
    pub fn with<R>(&self, borrow: impl FnOnce(&mut T) -> R) -> R {
        // SAFETY: there is one thread, and the borrow ends before anything else runs: calls of
        // the host do not come back.
        borrow(unsafe { &mut *self.0.get() })
    }
}

static CONSOLE: Single<Console> = Single::new(Console::new());

/// The journal of the match.
struct Journal;

impl Log for Journal {
    fn line(&mut self, stream: Stream, text: &str) {
        let level = match stream {
            Stream::Output => 1,
            Stream::Error => 3,
        };
        // SAFETY: the text is in this memory.
        unsafe { journal_log(level, text.as_ptr(), text.len()) }
    }
}

/// Ends the match with this message.
fn panic(text: &str) -> ! {
    // SAFETY: the text is in this memory.
    unsafe { journal_panic(text.as_ptr(), text.len()) };
    core::arch::wasm32::unreachable()
}

pub fn write(stream: Stream, bytes: &[u8]) {
    CONSOLE.with(|console| console.write(stream, bytes, &mut Journal));
}

pub fn end_call() {
    CONSOLE.with(|console| console.end_call(&mut Journal));
}

pub fn exit(code: u32) -> ! {
    CONSOLE.with(|console| panic(console.exit_message(code, &mut Journal)))
}

/// Ends the match because a function was called that robots do not have.
pub fn missing(function: &str) -> ! {
    CONSOLE.with(|console| console.flush(&mut Journal));
    let mut text = Text::<200>::new();
    text.push("called `");
    text.push(function);
    text.push("`, which is not available to robots");
    panic(text.as_str())
}

/// Where allocating begins, and whether what was allocated is not needed any more.
struct Arena {
    top: Cell<usize>,
    is_over: Cell<bool>,
}

static ARENA: Single<Arena> = Single::new(Arena {
    top: Cell::new(0),
    is_over: Cell::new(true),
});

/// A page of linear memory. Unit: bytes.
const PAGE_BYTES: usize = 65536;

/// Memory for the arguments or results of one call.
pub fn allocate(bytes: usize, align: usize) -> *mut u8 {
    unsafe extern "C" {
        /// Where free memory begins; from the linker.
        static __heap_base: u8;
    }
    ARENA.with(|arena| {
        if arena.is_over.replace(false) {
            arena.top.set(&raw const __heap_base as usize);
        }
        let begin = arena.top.get().next_multiple_of(align.max(1));
        let Some(end) = begin.checked_add(bytes) else {
            core::arch::wasm32::unreachable()
        };
        let present = core::arch::wasm32::memory_size(0) * PAGE_BYTES;
        if end > present {
            let pages = (end - present).div_ceil(PAGE_BYTES);
            if core::arch::wasm32::memory_grow(0, pages) == usize::MAX {
                core::arch::wasm32::unreachable()
            }
        }
        arena.top.set(end);
        begin as *mut u8
    })
}

/// A call ends: what was allocated for it is free when something else is allocated. Its caller
/// has copied the results by then.
pub fn release() {
    ARENA.with(|arena| arena.is_over.set(true));
}

/// Allocates memory for arguments. The caller knows their size, so nothing is ever enlarged.
#[unsafe(export_name = "cabi_realloc")]
extern "C" fn realloc(old: usize, _old_bytes: usize, align: usize, bytes: usize) -> *mut u8 {
    if old != 0 {
        core::arch::wasm32::unreachable()
    }
    allocate(bytes, align)
}

#[panic_handler]
fn on_panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
