/* What runs before main on the microcontroller. */

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

extern char data_start[], data_end[], data_load[], bss_start[], bss_end[], stack_top[];
extern void initialise_monitor_handles(void);
extern int main(void);

static void fault(void)
{
    _Exit(3);
}

/* What a program does when the timer of the core starts anew: nothing, unless it has a function of this name. */
void timer_round(void);
__attribute__((weak)) void timer_round(void)
{
}

static void reset(void)
{
#ifdef __ARM_FP
    /* After a reset the floating-point unit is off, and its first instruction would be a fault. */
    *(volatile uint32_t *)0xe000ed88u |= 0xfu << 20;
    __asm__ volatile("dsb\n\tisb");
#endif
    memcpy(data_start, data_load, (size_t)(data_end - data_start));
    memset(bss_start, 0, (size_t)(bss_end - bss_start));
    /* Standard output of newlib by semihosting. */
    initialise_monitor_handles();
    exit(main());
}

__attribute__((section(".vectors"), used)) static const uintptr_t VECTORS[] = {
    (uintptr_t)stack_top, (uintptr_t)reset, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault,
    (uintptr_t)fault, 0u, 0u, 0u, 0u, (uintptr_t)fault, (uintptr_t)fault, 0u, (uintptr_t)fault, (uintptr_t)timer_round,
};
