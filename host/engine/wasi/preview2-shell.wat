;; A robot with preview 2 inside: the component that answers it, the robot, and an entry that the
;; host calls in place of the robot. The empty components stand for the first two; see
;; preview1-shell.wat.
(component $robot_with_wasi
  TYPES
  JOURNAL
  (component $wasi)
  (instance $wasi (instantiate $wasi
    (with "wasmouse:robot/types@VERSION" (instance $types))
    (with "wasmouse:robot/journal@VERSION" (instance $journal))))
  (alias export $wasi "wasmouse:wasi/match@0.1.0" (instance $match))
  ;; What the robot may import.
  (alias export $wasi "wasi:io/error@0.2.12" (instance))
  (alias export $wasi "wasi:io/poll@0.2.12" (instance))
  (alias export $wasi "wasi:io/streams@0.2.12" (instance))
  (alias export $wasi "wasi:clocks/monotonic-clock@0.2.12" (instance))
  (alias export $wasi "wasi:clocks/wall-clock@0.2.12" (instance))
  (alias export $wasi "wasi:random/random@0.2.12" (instance))
  (alias export $wasi "wasi:random/insecure@0.2.12" (instance))
  (alias export $wasi "wasi:random/insecure-seed@0.2.12" (instance))
  (alias export $wasi "wasi:cli/environment@0.2.12" (instance))
  (alias export $wasi "wasi:cli/exit@0.2.12" (instance))
  (alias export $wasi "wasi:cli/stdin@0.2.12" (instance))
  (alias export $wasi "wasi:cli/stdout@0.2.12" (instance))
  (alias export $wasi "wasi:cli/stderr@0.2.12" (instance))
  (alias export $wasi "wasi:cli/terminal-input@0.2.12" (instance))
  (alias export $wasi "wasi:cli/terminal-output@0.2.12" (instance))
  (alias export $wasi "wasi:cli/terminal-stdin@0.2.12" (instance))
  (alias export $wasi "wasi:cli/terminal-stdout@0.2.12" (instance))
  (alias export $wasi "wasi:cli/terminal-stderr@0.2.12" (instance))
  (alias export $wasi "wasi:filesystem/types@0.2.12" (instance))
  (alias export $wasi "wasi:filesystem/preopens@0.2.12" (instance))
  (alias export $wasi "wasi:sockets/network@0.2.12" (instance))
  (alias export $wasi "wasi:sockets/instance-network@0.2.12" (instance))
  (alias export $wasi "wasi:sockets/udp@0.2.12" (instance))
  (alias export $wasi "wasi:sockets/udp-create-socket@0.2.12" (instance))
  (alias export $wasi "wasi:sockets/tcp@0.2.12" (instance))
  (alias export $wasi "wasi:sockets/tcp-create-socket@0.2.12" (instance))
  (alias export $wasi "wasi:sockets/ip-name-lookup@0.2.12" (instance))

  (component $robot)
  (instance $robot (instantiate $robot))
  (alias export $robot "wasmouse:robot/controller@VERSION" (instance $controller))

  ;; Called by the host in place of the robot: before `start` the seed, after each call the end of
  ;; it. A component of its own, because a component must not call those that it contains.
  (component $entry
    TYPES
    (alias export $types "briefing" (type $briefing))
    (alias export $types "sensors" (type $sensors))
    (alias export $types "action" (type $action))
    (import "robot" (instance $robot
      (alias outer $entry $briefing (type $briefing))
      (alias outer $entry $sensors (type $sensors))
      (alias outer $entry $action (type $action))
      (export "start" (func (param "briefing" $briefing)))
      (export "next-move" (func (param "sensors" $sensors) (result $action)))))
    (import "match" (instance $match
      (export "begin" (func (param "seed" u64)))
      (export "end-call" (func))))
    (alias export $robot "start" (func $robot_start))
    (alias export $robot "next-move" (func $robot_next_move))
    (alias export $match "begin" (func $match_begin))
    (alias export $match "end-call" (func $match_end_call))

    ;; The action passes through this memory.
    (core module $memory (memory (export "memory") 1 1))
    (core instance $memory (instantiate $memory))
    (alias core export $memory "memory" (core memory $memory))

    (core module $code
      (import "robot" "start" (func $start
        (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i64 i32)))
      (import "robot" "next-move" (func $next_move (param i32 i32 i32 i32)))
      (import "match" "begin" (func $begin (param i64)))
      (import "match" "end-call" (func $end_call))
      (func (export "start")
        (param i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32 i32)
        (param $seed i64) (param $variant i32)
        (call $begin (local.get $seed))
        (call $start
          (local.get 0) (local.get 1) (local.get 2) (local.get 3) (local.get 4) (local.get 5)
          (local.get 6) (local.get 7) (local.get 8) (local.get 9) (local.get 10) (local.get 11)
          (local.get $seed) (local.get $variant))
        (call $end_call))
      (func (export "next-move") (param i32 i32 i32) (result i32)
        (call $next_move (local.get 0) (local.get 1) (local.get 2) (i32.const 0))
        (call $end_call)
        (i32.const 0)))
    (core func $robot_start (canon lower (func $robot_start)))
    (core func $robot_next_move (canon lower (func $robot_next_move) (memory $memory)))
    (core func $begin (canon lower (func $match_begin)))
    (core func $end_call (canon lower (func $match_end_call)))
    (core instance $code (instantiate $code
      (with "robot" (instance
        (export "start" (func $robot_start))
        (export "next-move" (func $robot_next_move))))
      (with "match" (instance
        (export "begin" (func $begin))
        (export "end-call" (func $end_call))))))
    (alias core export $code "start" (core func $start))
    (alias core export $code "next-move" (core func $next_move))
    (func $start (param "briefing" $briefing) (canon lift (core func $start)))
    (func $next_move (param "sensors" $sensors) (result $action)
      (canon lift (core func $next_move) (memory $memory)))
    (export "start" (func $start))
    (export "next-move" (func $next_move)))
  (instance $entry (instantiate $entry
    (with "wasmouse:robot/types@VERSION" (instance $types))
    (with "robot" (instance $controller))
    (with "match" (instance $match))))

  (alias export $types "briefing" (type $briefing))
  (alias export $types "sensors" (type $sensors))
  (alias export $types "action" (type $action))
  (alias export $entry "start" (func $start))
  (alias export $entry "next-move" (func $next_move))
  (instance $entry_controller
    (export "briefing" (type $briefing))
    (export "sensors" (type $sensors))
    (export "action" (type $action))
    (export "start" (func $start))
    (export "next-move" (func $next_move)))
  (export "wasmouse:robot/controller@VERSION" (instance $entry_controller))
)
