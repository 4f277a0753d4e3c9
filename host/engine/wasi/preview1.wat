;; The adapter for modules that import `wasi_snapshot_preview1`: Go, C and C++ with libc, Rust on
;; wasm32-wasip1. It shares the memory of the module and changes nothing in it but the results of
;; calls, because some allocators take all memory that they find. What it has to remember is in
;; globals; lines are put together in a component with memory of its own (`wasmouse:wasi/console`).
;;
;; It stands between the host and the module, too: `start` and `next-move` are called through it.
;; docs/WASI.md says what each function answers.
(module
  (import "env" "memory" (memory 0))
  (import "wasmouse:wasi/console@0.1.0" "write" (func $write (param $descriptor i32) (param $at i32) (param $length i32)))
  (import "wasmouse:wasi/console@0.1.0" "end-call" (func $end_call))
  (import "wasmouse:wasi/console@0.1.0" "exit" (func $exit (param $code i32)))
  (import "wasmouse:wasi/console@0.1.0" "missing" (func $missing (param $function i32)))
  (import "__main_module__" "wasmouse:robot/controller@0.2.0#start" (func $main_start
    (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32)))
  (import "__main_module__" "wasmouse:robot/controller@0.2.0#next-move" (func $main_next_move
    (param i32 i32 i32) (result i32)))

  ;; Both clocks. Unit: nanoseconds.
  (global $clock (mut i64) (i64.const 0))
  ;; The state of SplitMix64, as in guest/src/random.rs; its seed before `start`.
  (global $random (mut i64) (i64.const 0))
  ;; Whether anything was written in this call of the robot.
  (global $has_written (mut i32) (i32.const 0))

  (func (export "wasmouse:robot/controller@0.2.0#start")
    (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32) (param $seed i64) (param $variant i32)
    (global.set $random (local.get $seed))
    (call $main_start
      (local.get 0) (local.get 1) (local.get 2) (local.get 3) (local.get 4) (local.get 5)
      (local.get 6) (local.get 7) (local.get 8) (local.get 9) (local.get 10) (local.get 11)
      (local.get $seed) (local.get $variant))
    (call $end))

  (func (export "wasmouse:robot/controller@0.2.0#next-move") (param i32 i32 i32) (result i32)
    (call $main_next_move (local.get 0) (local.get 1) (local.get 2))
    (call $end))

  (func $end
    (if (global.get $has_written) (then
      (global.set $has_written (i32.const 0))
      (call $end_call))))

  ;; Error numbers: 0 success, 8 bad descriptor, 28 invalid argument, 44 no such file, 70 not
  ;; seekable.

  ;; No arguments, no environment.
  (func (export "args_sizes_get") (param i32 i32) (result i32)
    (call $two_zeros (local.get 0) (local.get 1)))
  (func (export "args_get") (param i32 i32) (result i32) (i32.const 0))
  (func (export "environ_sizes_get") (param i32 i32) (result i32)
    (call $two_zeros (local.get 0) (local.get 1)))
  (func (export "environ_get") (param i32 i32) (result i32) (i32.const 0))
  (func $two_zeros (param $first i32) (param $second i32) (result i32)
    (i32.store (local.get $first) (i32.const 0))
    (i32.store (local.get $second) (i32.const 0))
    (i32.const 0))

  ;; Clocks: realtime (0) and monotonic (1) are one counter, 1,000 ns a reading. There are no
  ;; others.
  (func (export "clock_res_get") (param $clock i32) (param $result i32) (result i32)
    (if (i32.gt_u (local.get $clock) (i32.const 1)) (then (return (i32.const 28))))
    (i64.store (local.get $result) (i64.const 1000))
    (i32.const 0))
  (func (export "clock_time_get") (param $id i32) (param $precision i64) (param $result i32) (result i32)
    (if (i32.gt_u (local.get $id) (i32.const 1)) (then (return (i32.const 28))))
    (global.set $clock (i64.add (global.get $clock) (i64.const 1000)))
    (i64.store (local.get $result) (global.get $clock))
    (i32.const 0))

  (func (export "random_get") (param $at i32) (param $length i32) (result i32)
    (local $bits i64)
    (loop $eight
      (if (i32.ge_u (local.get $length) (i32.const 8)) (then
        (i64.store (local.get $at) (call $bits))
        (local.set $at (i32.add (local.get $at) (i32.const 8)))
        (local.set $length (i32.sub (local.get $length) (i32.const 8)))
        (br $eight))))
    (if (local.get $length) (then
      (local.set $bits (call $bits))
      (loop $one
        (i64.store8 (local.get $at) (local.get $bits))
        (local.set $bits (i64.shr_u (local.get $bits) (i64.const 8)))
        (local.set $at (i32.add (local.get $at) (i32.const 1)))
        (local.set $length (i32.sub (local.get $length) (i32.const 1)))
        (br_if $one (local.get $length)))))
    (i32.const 0))
  (func $bits (result i64)
    (local $bits i64)
    (global.set $random (i64.add (global.get $random) (i64.const 0x9e3779b97f4a7c15)))
    (local.set $bits (global.get $random))
    (local.set $bits (i64.mul
      (i64.xor (local.get $bits) (i64.shr_u (local.get $bits) (i64.const 30)))
      (i64.const 0xbf58476d1ce4e5b9)))
    (local.set $bits (i64.mul
      (i64.xor (local.get $bits) (i64.shr_u (local.get $bits) (i64.const 27)))
      (i64.const 0x94d049bb133111eb)))
    (i64.xor (local.get $bits) (i64.shr_u (local.get $bits) (i64.const 31))))

  ;; Everything that is waited for has happened: timers have run down, so the clock goes on to
  ;; the latest, and descriptors are ready.
  (func (export "poll_oneoff") (param $in i32) (param $out i32) (param $n i32) (param $count i32) (result i32)
    (local $deadline i64)
    (if (i32.eqz (local.get $n)) (then (return (i32.const 28))))
    (i32.store (local.get $count) (local.get $n))
    (loop $next
      ;; The user's data and the type are those of the subscription; the rest is zero.
      (i64.store offset=0 (local.get $out) (i64.load offset=0 (local.get $in)))
      (i64.store offset=8 (local.get $out)
        (i64.shl (i64.load8_u offset=8 (local.get $in)) (i64.const 16)))
      (i64.store offset=16 (local.get $out) (i64.const 0))
      (i64.store offset=24 (local.get $out) (i64.const 0))
      (if (i32.eqz (i32.load8_u offset=8 (local.get $in))) (then
        (local.set $deadline (i64.load offset=24 (local.get $in)))
        ;; Flag 1: the time is absolute.
        (if (i32.eqz (i32.and (i32.load16_u offset=40 (local.get $in)) (i32.const 1))) (then
          (local.set $deadline (i64.add (local.get $deadline) (global.get $clock)))))
        (if (i64.gt_u (local.get $deadline) (global.get $clock)) (then
          (global.set $clock (local.get $deadline))))))
      (local.set $in (i32.add (local.get $in) (i32.const 48)))
      (local.set $out (i32.add (local.get $out) (i32.const 32)))
      (local.set $n (i32.sub (local.get $n) (i32.const 1)))
      (br_if $next (local.get $n)))
    (i32.const 0))

  (func (export "sched_yield") (result i32) (i32.const 0))

  (func (export "proc_exit") (param $code i32)
    (call $exit (local.get $code))
    (unreachable))

  ;; Descriptors 0, 1 and 2; there are no others, and none can be opened.
  (func (export "fd_write") (param $fd i32) (param $vectors i32) (param $n i32) (param $written i32) (result i32)
    (local $length i32) (local $sum i32)
    (if (i32.gt_u (i32.sub (local.get $fd) (i32.const 1)) (i32.const 1)) (then
      (return (i32.const 8))))
    (block $end
      (loop $next
        (br_if $end (i32.eqz (local.get $n)))
        (local.set $length (i32.load offset=4 (local.get $vectors)))
        (if (local.get $length) (then
          (global.set $has_written (i32.const 1))
          (call $write (local.get $fd) (i32.load (local.get $vectors)) (local.get $length))))
        (local.set $sum (i32.add (local.get $sum) (local.get $length)))
        (local.set $vectors (i32.add (local.get $vectors) (i32.const 8)))
        (local.set $n (i32.sub (local.get $n) (i32.const 1)))
        (br $next)))
    (i32.store (local.get $written) (local.get $sum))
    (i32.const 0))
  ;; The end of the file.
  (func (export "fd_read") (param $fd i32) (param $vectors i32) (param $n i32) (param $read i32) (result i32)
    (if (local.get $fd) (then (return (i32.const 8))))
    (i32.store (local.get $read) (i32.const 0))
    (i32.const 0))
  ;; A character device that cannot seek, which is how libc knows a terminal: it then writes
  ;; standard output line by line, where it would otherwise keep it until the program exits.
  (func (export "fd_fdstat_get") (param $fd i32) (param $result i32) (result i32)
    (if (i32.gt_u (local.get $fd) (i32.const 2)) (then (return (i32.const 8))))
    (i64.store offset=0 (local.get $result) (i64.const 2))
    ;; Rights: to poll, and to read (descriptor 0) or to write.
    (i64.store offset=8 (local.get $result)
      (select (i64.const 0x8000040) (i64.const 0x8000002) (local.get $fd)))
    (i64.store offset=16 (local.get $result) (i64.const 0))
    (i32.const 0))
  (func (export "fd_filestat_get") (param $fd i32) (param $result i32) (result i32)
    (if (i32.gt_u (local.get $fd) (i32.const 2)) (then (return (i32.const 8))))
    (memory.fill (local.get $result) (i32.const 0) (i32.const 64))
    (i32.store8 offset=16 (local.get $result) (i32.const 2))
    (i32.const 0))
  (func $standard (param $fd i32) (result i32)
    (select (i32.const 8) (i32.const 0) (i32.gt_u (local.get $fd) (i32.const 2))))
  (func (export "fd_close") (param i32) (result i32) (call $standard (local.get 0)))
  (func (export "fd_datasync") (param i32) (result i32) (call $standard (local.get 0)))
  (func (export "fd_sync") (param i32) (result i32) (call $standard (local.get 0)))
  (func (export "fd_fdstat_set_flags") (param i32 i32) (result i32) (call $standard (local.get 0)))
  (func (export "fd_fdstat_set_rights") (param i32 i64 i64) (result i32) (call $standard (local.get 0)))
  (func $not_seekable (param $fd i32) (result i32)
    (select (i32.const 8) (i32.const 70) (i32.gt_u (local.get $fd) (i32.const 2))))
  (func (export "fd_seek") (param i32 i64 i32 i32) (result i32) (call $not_seekable (local.get 0)))
  (func (export "fd_tell") (param i32 i32) (result i32) (call $not_seekable (local.get 0)))
  (func (export "fd_pread") (param i32 i32 i32 i64 i32) (result i32) (call $not_seekable (local.get 0)))
  (func (export "fd_pwrite") (param i32 i32 i32 i64 i32) (result i32) (call $not_seekable (local.get 0)))
  ;; What only files and folders have.
  (func (export "fd_advise") (param i32 i64 i64 i32) (result i32) (i32.const 8))
  (func (export "fd_allocate") (param i32 i64 i64) (result i32) (i32.const 8))
  (func (export "fd_filestat_set_size") (param i32 i64) (result i32) (i32.const 8))
  (func (export "fd_filestat_set_times") (param i32 i64 i64 i32) (result i32) (i32.const 8))
  (func (export "fd_prestat_get") (param i32 i32) (result i32) (i32.const 8))
  (func (export "fd_prestat_dir_name") (param i32 i32 i32) (result i32) (i32.const 8))
  (func (export "fd_readdir") (param i32 i32 i32 i64 i32) (result i32) (i32.const 8))
  (func (export "fd_renumber") (param i32 i32) (result i32) (i32.const 8))

  ;; There are no files, so nothing is found. Programs look for files that they can do without:
  ;; Go for time zones.
  (func (export "path_open") (param i32 i32 i32 i32 i32 i64 i64 i32 i32) (result i32) (i32.const 44))
  (func (export "path_filestat_get") (param i32 i32 i32 i32 i32) (result i32) (i32.const 44))
  (func (export "path_readlink") (param i32 i32 i32 i32 i32 i32) (result i32) (i32.const 44))

  ;; What is not answered, by its number in guest/src/preview1.rs.
  (func $no (param $function i32) (result i32) (call $missing (local.get $function)) (unreachable))
  (func (export "path_create_directory") (param i32 i32 i32) (result i32) (call $no (i32.const 0)))
  (func (export "path_filestat_set_times") (param i32 i32 i32 i32 i64 i64 i32) (result i32) (call $no (i32.const 1)))
  (func (export "path_link") (param i32 i32 i32 i32 i32 i32 i32) (result i32) (call $no (i32.const 2)))
  (func (export "path_remove_directory") (param i32 i32 i32) (result i32) (call $no (i32.const 3)))
  (func (export "path_rename") (param i32 i32 i32 i32 i32 i32) (result i32) (call $no (i32.const 4)))
  (func (export "path_symlink") (param i32 i32 i32 i32 i32) (result i32) (call $no (i32.const 5)))
  (func (export "path_unlink_file") (param i32 i32 i32) (result i32) (call $no (i32.const 6)))
  (func (export "proc_raise") (param i32) (result i32) (call $no (i32.const 7)))
  (func (export "sock_accept") (param i32 i32 i32) (result i32) (call $no (i32.const 8)))
  (func (export "sock_recv") (param i32 i32 i32 i32 i32 i32) (result i32) (call $no (i32.const 9)))
  (func (export "sock_send") (param i32 i32 i32 i32 i32) (result i32) (call $no (i32.const 10)))
  (func (export "sock_shutdown") (param i32 i32) (result i32) (call $no (i32.const 11)))
)
