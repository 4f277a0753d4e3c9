;; The wall follower: straight on unless there is a wall ahead; then, with walls on both sides, it
;; turns around; otherwise it turns to the open side. Variant 0 prefers left where both sides are
;; open, variant 1 right. It resets in the goal and drives the same path again.
(module
  (import "wasmouse:robot/journal@0.2.0" "panic" (func $panic (param $text i32) (param $bytes i32)))

  ;; Address 0 has the answer of `next-move`, three bytes:
  ;;   0: what to do: 0 move, 1 reset
  ;;   1: the turn: 0 left, 1 straight, 2 right
  ;;   2: how far to drive, in cells; negative drives backwards
  ;; Address 16 has the text for unknown variants.
  (memory (export "memory") 1)
  (data (i32.const 16) "the wall follower has the variants 0 and 1")

  (global $start_x (mut i32) (i32.const 0))
  (global $start_y (mut i32) (i32.const 0))
  (global $goal_x (mut i32) (i32.const 0))
  (global $goal_y (mut i32) (i32.const 0))
  (global $goal_width (mut i32) (i32.const 0))
  (global $goal_height (mut i32) (i32.const 0))
  (global $prefers_right (mut i32) (i32.const 0))

  ;; Where the robot is; its heading is 0 up, 1 right, 2 down, 3 left.
  (global $x (mut i32) (i32.const 0))
  (global $y (mut i32) (i32.const 0))
  (global $heading (mut i32) (i32.const 0))
  (global $exploring (mut i32) (i32.const 1))

  ;; Called once, before the first step.
  (func $start (export "wasmouse:robot/controller@0.2.0#start")
    (param $dimension i32)
    (param $start_x i32) (param $start_y i32)
    (param $goal_x i32) (param $goal_y i32) (param $goal_width i32) (param $goal_height i32)
    (param $budget i32) (param $budget_scope i32)
    (param $longest_move i32) (param $units_per_cell i32) (param $exploration_divisor i32)
    (param $seed i64) (param $variant i32)
    (if (i32.gt_u (local.get $variant) (i32.const 1))
      (then (call $panic (i32.const 16) (i32.const 42))))
    (global.set $prefers_right (local.get $variant))
    (global.set $start_x (local.get $start_x))
    (global.set $start_y (local.get $start_y))
    (global.set $goal_x (local.get $goal_x))
    (global.set $goal_y (local.get $goal_y))
    (global.set $goal_width (local.get $goal_width))
    (global.set $goal_height (local.get $goal_height))
    (call $go_to_start))

  ;; Called once a step with the open cells in three directions; returns the address of the answer.
  (func $next_move (export "wasmouse:robot/controller@0.2.0#next-move")
    (param $left i32) (param $front i32) (param $right i32) (result i32)
    (if (i32.and (global.get $exploring) (i32.and (call $in_goal) (call $away_from_start)))
      (then
        (global.set $exploring (i32.const 0))
        (call $go_to_start)
        (i32.store8 offset=0 (i32.const 0) (i32.const 1))
        (return (i32.const 0))))
    (if (local.get $front)
      (then (return (call $move (i32.const 1) (i32.const 1)))))
    (if (i32.and
          (i32.ne (local.get $left) (i32.const 0))
          (i32.ne (local.get $right) (i32.const 0)))
      (then (return (call $move
        (select (i32.const 2) (i32.const 0) (global.get $prefers_right))
        (i32.const 1)))))
    (if (local.get $left)
      (then (return (call $move (i32.const 0) (i32.const 1)))))
    (if (local.get $right)
      (then (return (call $move (i32.const 2) (i32.const 1)))))
    ;; A dead end: a step cannot turn by 180 degrees, so the next one turns left again.
    (call $move (i32.const 0) (i32.const 0)))

  ;; Turns, drives that many cells, and writes the answer. Only open cells are driven to.
  (func $move (param $turn i32) (param $advance i32) (result i32)
    ;; Left is one quarter turn back, which is three on.
    (global.set $heading
      (i32.and
        (i32.add (global.get $heading) (i32.add (local.get $turn) (i32.const 3)))
        (i32.const 3)))
    (if (local.get $advance)
      (then
        (global.set $x (i32.add (global.get $x)
          (i32.sub
            (i32.eq (global.get $heading) (i32.const 1))
            (i32.eq (global.get $heading) (i32.const 3)))))
        (global.set $y (i32.add (global.get $y)
          (i32.sub
            (i32.eq (global.get $heading) (i32.const 0))
            (i32.eq (global.get $heading) (i32.const 2)))))))
    (i32.store8 offset=0 (i32.const 0) (i32.const 0))
    (i32.store8 offset=1 (i32.const 0) (local.get $turn))
    (i32.store8 offset=2 (i32.const 0) (local.get $advance))
    (i32.const 0))

  (func $go_to_start
    (global.set $x (global.get $start_x))
    (global.set $y (global.get $start_y))
    (global.set $heading (i32.const 0)))

  ;; Unsigned: a cell before the goal's corner is very far behind it.
  (func $in_goal (result i32)
    (i32.and
      (i32.lt_u (i32.sub (global.get $x) (global.get $goal_x)) (global.get $goal_width))
      (i32.lt_u (i32.sub (global.get $y) (global.get $goal_y)) (global.get $goal_height))))

  (func $away_from_start (result i32)
    (i32.or
      (i32.ne (global.get $x) (global.get $start_x))
      (i32.ne (global.get $y) (global.get $start_y)))))
