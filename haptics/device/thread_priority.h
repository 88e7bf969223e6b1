// SCHED_FIFO priorities of the threads behind a force. The servo waits for the USB's thread, and that for the kernel's
// interrupt threads, which run at 50 (kernel/irq/manage.c: sched_set_fifo(), half of MAX_RT_PRIO, on PREEMPT_RT and
// with threadirqs): who is waited for must not be held up by who waits, so the servo lies lowest unless its user says
// otherwise. Plain numbers.
#pragma once

namespace haptics {

inline constexpr int kInterruptPriority = 50;
inline constexpr int kServoPriority = 45;

/// The USB's thread beside a servo of this priority.
constexpr int usbPriority(int servo_priority) { return servo_priority + 1; }
/// Of SCHED_FIFO's 1 to 99 the last one is the USB's.
inline constexpr int kMinServoPriority = 1, kMaxServoPriority = 98;
static_assert(usbPriority(kServoPriority) < kInterruptPriority);

}  // namespace haptics
