//! Threads of this process.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// The threads, and the process that started them. A fork copies this, but no thread: the copy needs threads of its own. The lock is
/// taken by those alone who hold the interpreter's lock, as a fork does, so that no copy of it stays locked.
static THREADS: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

fn threads() -> PyResult<Arc<ThreadPool>> {
    let mut threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((_, pool)) = threads.as_ref().filter(|(owner, _)| *owner == process) {
        return Ok(pool.clone());
    }
    let built = ThreadPoolBuilder::new().build();
    let pool = Arc::new(built.map_err(|error| PyRuntimeError::new_err(format!("threads cannot be started: {error}")))?);
    if let Some(of_parent) = threads.replace((process, pool.clone())) {
        // Dropping them would wait for threads that are not there.
        std::mem::forget(of_parent);
    }
    Ok(pool)
}

/// Computes on all cores, with the interpreter's lock released.
pub(crate) fn on_all_cores<T: Send>(python: Python<'_>, compute: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = threads()?;
    Ok(python.detach(|| pool.install(compute)))
}

/// How long Ctrl-C waits to be seen.
const BETWEEN_SIGNALS: Duration = Duration::from_millis(50);

/// Computes on all cores, with the interpreter's lock released. If Python has a signal to handle and its handler raises an exception, the
/// flag asks the computation to end, and the exception takes the place of its result.
pub(crate) fn until_interrupted<T: Send>(
    python: Python<'_>,
    compute: impl FnOnce(&Arc<AtomicBool>) -> T + Send,
) -> PyResult<T> {
    let (pool, stop) = (threads()?, Arc::new(AtomicBool::new(false)));
    python.detach(|| {
        let (mut signal, mut result) = (Ok(()), None);
        let (ended, end) = mpsc::channel::<()>();
        pool.in_place_scope(|scope| {
            let (result, stop) = (&mut result, &stop);
            scope.spawn(move |_| {
                *result = Some(compute(stop));
                drop(ended);
            });
            // Until the sender is dropped.
            while end.recv_timeout(BETWEEN_SIGNALS) == Err(RecvTimeoutError::Timeout) {
                if signal.is_ok() {
                    signal = Python::attach(|python| python.check_signals());
                    if signal.is_err() {
                        stop.store(true, Ordering::Relaxed);
                    }
                }
            }
        });
        signal?;
        result.ok_or_else(|| PyRuntimeError::new_err("the computation has no result"))
    })
}
