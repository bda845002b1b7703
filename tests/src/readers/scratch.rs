//! A file for readers that open one.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

thread_local! {
    static FOLDER: TempDir = tempfile::tempdir().expect("a folder for scratch files");
}

/// What `read` makes of a file of these bytes.
pub(super) fn in_file<T>(bytes: &[u8], read: impl FnOnce(&Path) -> T) -> T {
    FOLDER.with(|folder| {
        let path = folder.path().join("input");
        fs::write(&path, bytes).expect("the file is written");
        let result = read(&path);
        // A new file is written faster than an old one is replaced.
        fs::remove_file(&path).expect("the file is removed");
        result
    })
}
