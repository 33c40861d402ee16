/* Registers: RM0090, sections 5 (PWR), 7 (RCC), 8 (GPIO) and 3.9 (flash). */
#include "board.h"

#include "base/compiler.h"

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

#define RCC_CR REGISTER(0x40023800u)
#define RCC_PLLCFGR REGISTER(0x40023804u)
#define RCC_CFGR REGISTER(0x40023808u)
#define RCC_AHB1ENR REGISTER(0x40023830u)
#define RCC_APB1ENR REGISTER(0x40023840u)
#define RCC_APB2ENR REGISTER(0x40023844u)
#define FLASH_ACR REGISTER(0x40023C00u)
#define PWR_CR REGISTER(0x40007000u)

#define GPIOA_BASE 0x40020000u
#define GPIOB_BASE 0x40020400u

enum {
    CR_HSI_ON = 1 << 0,
    CR_HSE_ON = 1 << 16,
    CR_HSE_READY = 1 << 17,
    CR_PLL_ON = 1 << 24,
    CR_PLL_READY = 1 << 25,
    /* 25 MHz / 25 x 336 / 2 = 168 MHz; /7 = 48 MHz for what needs it */
    PLL_M = 25,
    PLL_N = 336,
    PLL_SETTING = PLL_M | PLL_N << 6 | 0 << 16 | 1 << 22 | 7 << 24,
    CFGR_USE_PLL = 2,
    CFGR_USES_PLL = 2 << 2,
    CFGR_USES = 3 << 2,
    CFGR_BUSES = 5 << 10 | 4 << 13, /* APB1 a quarter, APB2 half */
    ACR_LATENCY = 15,
    ACR_5_WAITS = 5, /* 150 to 168 MHz at 2.7 V and more */
    ACR_CACHES = 1 << 8 | 1 << 9 | 1 << 10,
    PWR_SCALE_1 = 1 << 14,

    AHB1_GPIOA_GPIOB = 3,
    APB1_TIM2_USART2_PWR = 1 << 0 | 1 << 17 | 1 << 28,
    APB2_USART1 = 1 << 4,

    LED_PIN = 10, /* PA10 */
    USART_FUNCTION = 7,
    WAITS_MAX = 1000000 /* looks at a flag; a crystal takes some 2 ms, a few ten thousand of them */
};

BASE_STATIC_ASSERT(BOARD_CRYSTAL_HZ / PLL_M * PLL_N / 2 == BOARD_CORE_HZ, pll_makes_the_core_clock);

struct gpio_block {
    volatile uint32_t mode, type, speed, pull, in, out, set_clear, lock, function[2];
};

static struct gpio_block *gpio(uint32_t base) { return (struct gpio_block *)(uintptr_t)base; }

static void set_field(volatile uint32_t *reg, unsigned shift, unsigned width, uint32_t value)
{
    const uint32_t mask = ((1u << width) - 1u) << shift;

    *reg = (*reg & ~mask) | (value << shift);
}

/* Alternate function, fast, pulled up so that an open receive line is idle. */
static void give_to_usart(uint32_t base, unsigned pin)
{
    set_field(&gpio(base)->function[pin / 8u], 4u * (pin % 8u), 4u, USART_FUNCTION);
    set_field(&gpio(base)->speed, 2u * pin, 2u, 2u);
    set_field(&gpio(base)->pull, 2u * pin, 2u, 1u);
    set_field(&gpio(base)->mode, 2u * pin, 2u, 2u);
}

bool clocks_are_real(void) { return (RCC_CR & CR_HSI_ON) != 0u; }

/* USART1 on PB6, PB7 (SCL and SDA of the header: its other pins carry USB and the LED), USART2 on PA2, PA3 (D3 and
 * D2). */
void clocks_open_pins(void)
{
    RCC_AHB1ENR |= AHB1_GPIOA_GPIOB;
    RCC_APB1ENR |= APB1_TIM2_USART2_PWR;
    RCC_APB2ENR |= APB2_USART1;
    (void)RCC_APB2ENR; /* a clock is there two cycles after it was asked for */
    give_to_usart(GPIOB_BASE, 6u);
    give_to_usart(GPIOB_BASE, 7u);
    give_to_usart(GPIOA_BASE, 2u);
    give_to_usart(GPIOA_BASE, 3u);
    set_field(&gpio(GPIOA_BASE)->mode, 2u * LED_PIN, 2u, 1u);
}

void clocks_set_led(bool is_on) { gpio(GPIOA_BASE)->set_clear = 1u << (is_on ? LED_PIN : LED_PIN + 16); }

static bool wait_for(volatile uint32_t *reg, uint32_t mask, uint32_t value)
{
    for (uint32_t looks = 0u; looks < WAITS_MAX; looks++) {
        if ((*reg & mask) == value) {
            return true;
        }
    }
    return false;
}

/* Flash waits first: at 168 MHz without them the next instruction would be read wrong. */
static bool speed_up(void)
{
    PWR_CR |= PWR_SCALE_1;
    RCC_CR |= CR_HSE_ON;
    if (!wait_for(&RCC_CR, CR_HSE_READY, CR_HSE_READY)) {
        return false;
    }
    RCC_PLLCFGR = PLL_SETTING;
    RCC_CR |= CR_PLL_ON;
    if (!wait_for(&RCC_CR, CR_PLL_READY, CR_PLL_READY)) {
        return false;
    }
    FLASH_ACR = ACR_5_WAITS | ACR_CACHES;
    if (!wait_for(&FLASH_ACR, ACR_LATENCY, ACR_5_WAITS)) {
        return false;
    }
    RCC_CFGR = CFGR_BUSES;
    RCC_CFGR = CFGR_BUSES | CFGR_USE_PLL;
    return wait_for(&RCC_CFGR, CFGR_USES, CFGR_USES_PLL);
}

struct board_clocks clocks_start(void)
{
    struct board_clocks clocks = {BOARD_RESET_HZ, BOARD_RESET_HZ, BOARD_RESET_HZ, BOARD_RESET_HZ};

    clocks_open_pins();
    if (!clocks_are_real()) {
        clocks.core = BOARD_CORE_HZ;
        clocks.timers = BOARD_EMULATED_TIMER_HZ;
    } else if (speed_up()) {
        clocks = (struct board_clocks){BOARD_CORE_HZ / 4, BOARD_CORE_HZ / 2, BOARD_CORE_HZ,
                                       BOARD_CORE_HZ / 2}; /* timers: twice APB1 */
    } else {
        RCC_CFGR = 0u; /* reset clock, undivided buses */
    }
    return clocks;
}
