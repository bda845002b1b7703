#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| typelift_tests::readers::format(bytes));
