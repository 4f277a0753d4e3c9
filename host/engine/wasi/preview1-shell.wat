;; A robot with preview 1 inside: the module with its adapter, and the component behind the
;; adapter. The empty components stand for those; the first is put in by `cargo xtask wasi`, the
;; second, with what is known of it only then, by `admission::wasi`.
(component $robot_with_wasi
  TYPES
  JOURNAL
  (component $console)
  (instance $console (instantiate $console
    (with "wasmouse:robot/types@VERSION" (instance $types))
    (with "wasmouse:robot/journal@VERSION" (instance $journal))))
  (alias export $console "wasmouse:wasi/console@0.1.0" (instance $console_interface))

  (component $robot)
  (instance $robot (instantiate $robot))
  (alias export $robot "wasmouse:robot/controller@VERSION" (instance $controller))

  (export "wasmouse:robot/controller@VERSION" (instance $controller))
)
