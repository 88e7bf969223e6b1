// SCHED_FIFO priorities of the threads behind a force. The servo waits for the USB thread, and that for the kernel's
// interrupt threads, which run at 50 (kernel/irq/manage.c: sched_set_fifo(), half of MAX_RT_PRIO, on PREEMPT_RT and
// with threadirqs). A waiting thread must not delay the one it waits for, so the servo is lowest unless its user says
// otherwise.
#pragma once

namespace haptics {

inline constexpr int kInterruptPriority = 50;
inline constexpr int kServoPriority = 45;

/// Of the USB thread of a servo with this priority.
constexpr int usbPriority(int servo_priority) { return servo_priority + 1; }
/// SCHED_FIFO has 1 to 99; the USB thread needs one above the servo.
inline constexpr int kMinServoPriority = 1, kMaxServoPriority = 98;
static_assert(usbPriority(kServoPriority) < kInterruptPriority);

}  // namespace haptics
