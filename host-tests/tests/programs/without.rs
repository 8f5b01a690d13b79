//! What the proof of absent terms takes out of a source.

use std::collections::BTreeMap;
use std::path::PathBuf;

use boards::without::{Parts, take_out};
use quote::ToTokens;
use syn::File;

#[test]
fn what_names_a_part_is_taken_out_and_what_names_that() {
    let source = "
        use crate::tables::{Table, read};
        use crate::law::Law;
        mod tables;
        struct Peeling<T>(T);
        struct Scene<T> { law: Law<T> }
        struct Held<T> { peeling: Peeling<T> }
        trait Term {}
        impl<T> Term for Peeling<T> {}
        impl<T> Term for Scene<T> {}
        impl<T> Scene<T> {
            fn with_peeling(self) -> Held<T> { Held(self) }
            fn law(&self) -> &Law<T> { &self.law }
            fn read(&self, file: &File) -> bool { file.read() }
        }
        fn holds<T>(held: &Held<T>) -> bool { true }
        fn answers<T>(scene: &Scene<T>) -> bool { holds(scene) }
        fn tabulated() -> bool { read() }
        fn remains<T>(scene: &Scene<T>) -> bool { scene.law().is_some() }
    ";
    let left = "
        use crate::law::Law;
        struct Scene<T> { law: Law<T> }
        trait Term {}
        impl<T> Term for Scene<T> {}
        impl<T> Scene<T> {
            fn law(&self) -> &Law<T> { &self.law }
            fn read(&self, file: &File) -> bool { file.read() }
        }
        fn remains<T>(scene: &Scene<T>) -> bool { scene.law().is_some() }
    ";
    let mut files = BTreeMap::from([(PathBuf::new(), syn::parse_file(source).unwrap())]);
    let parts = Parts { modules: vec!["tables"], types: vec!["Peeling"], methods: vec!["with_peeling"] };
    take_out(&mut files, &parts);
    let text = |file: &File| file.to_token_stream().to_string();
    assert_eq!(text(&files[&PathBuf::new()]), text(&syn::parse_file(left).unwrap()));
}
