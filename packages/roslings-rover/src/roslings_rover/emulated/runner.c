// Runs a sketch on an emulated ATmega2560 with two motors and two encoders on its pins.
//
//     runner SKETCH.elf LARGEST_RAD_S MOTOR_LAG_S TICKS_PER_TURN
//
// It does nothing by itself: for each request on standard input it lets a span of simulated time
// pass and answers on standard output, all numbers little-endian as the machine has them.
//
//   request   uint32 microseconds, uint32 n, n bytes for UART0
//   answer    struct state, then `sent` bytes from UART0, then `changes` structs change
//
// Pins: see the table in the sketch. The pins' registers are those of the ATmega2560's data sheet
// (Microchip DS40002211, section 33).

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <avr_ioport.h>
#include <avr_uart.h>
#include <sim_avr.h>
#include <sim_elf.h>

enum { HZ = 16000000, CYCLES_PER_US = 16, CYCLES_PER_BYTE = HZ / 11520 };
enum { MOTOR_STEP_US = 50, MOST_BYTES = 1 << 16, MOST_CHANGES = 1 << 12 };
enum { PORTA = 0x22, TCCR4A = 0xA0, OCR4AL = 0xA8, OCR4BL = 0xAA, PORTH = 0x102 };

struct wheel {
  int direction_bit;          // in PORTA
  int compare_bit, ocr;       // in TCCR4A: set while the timer drives the pin; its duty
  int pwm_bit;                // in PORTH: the pin's level while it does not
  int a_bit, b_bit;           // in port D
  double speed, angle;        // rad/s, rad
  int64_t ticks;
  avr_irq_t *a, *b;
};

static struct wheel wheels[2] = {
    {.direction_bit = 0, .compare_bit = 7, .ocr = OCR4AL, .pwm_bit = 3, .a_bit = 3, .b_bit = 2},
    {.direction_bit = 1, .compare_bit = 5, .ocr = OCR4BL, .pwm_bit = 4, .a_bit = 1, .b_bit = 0},
};

#pragma pack(push, 1)
static struct state {
  uint64_t time_us;
  double angle[2], speed[2];
  int16_t pwm[2];
  uint32_t sent, changes;
} state;

static struct change {
  uint64_t time_us;
  int16_t pwm[2];
} changes[MOST_CHANGES];
#pragma pack(pop)

static avr_t *avr;
static avr_irq_t *uart_in;
static uint8_t sent[MOST_BYTES], waiting[MOST_BYTES];
static uint32_t waiting_from, waiting_to;
static int uart_full;
static double largest_rad_s, lag_s, ticks_per_turn;

// --- motors and encoders ----------------------------------------------------------------------

static int16_t pwm_of(const struct wheel *w) {
  const uint8_t *io = avr->data;
  int by_timer = io[TCCR4A] >> w->compare_bit & 1;
  int duty = by_timer ? io[w->ocr] : (io[PORTH] >> w->pwm_bit & 1) * 255;
  return io[PORTA] >> w->direction_bit & 1 ? -duty : duty;
}

// A leads B when the wheel turns forward: 00, 10, 11, 01.
static void show_tick(struct wheel *w) {
  int phase = (int)(w->ticks & 3);
  avr_raise_irq(w->a, phase == 1 || phase == 2);
  avr_raise_irq(w->b, phase >= 2);
}

static void turn(struct wheel *w, int16_t pwm, double dt_s) {
  w->speed += (pwm / 255.0 * largest_rad_s - w->speed) * (1 - exp(-dt_s / lag_s));
  w->angle += w->speed * dt_s;
  int64_t ticks = (int64_t)floor(w->angle / (2 * M_PI) * ticks_per_turn);
  while (w->ticks != ticks) {
    w->ticks += w->ticks < ticks ? 1 : -1;
    show_tick(w);
  }
}

// A change counts when it lasts for two steps: the sketch sets its two motors one by one.
static void note_change(void) {
  static int16_t before[2];
  int16_t now[2] = {pwm_of(&wheels[0]), pwm_of(&wheels[1])};
  int steady = now[0] == before[0] && now[1] == before[1];
  int news = now[0] != state.pwm[0] || now[1] != state.pwm[1];
  memcpy(before, now, sizeof now);
  if (!steady || !news) return;
  memcpy(state.pwm, now, sizeof now);
  if (state.changes == MOST_CHANGES) return;
  struct change *c = &changes[state.changes++];
  c->time_us = avr->cycle / CYCLES_PER_US;
  memcpy(c->pwm, now, sizeof now);
}

static void step_motors(void) {
  note_change();
  for (int i = 0; i < 2; i++) {
    turn(&wheels[i], pwm_of(&wheels[i]), MOTOR_STEP_US / 1e6);
    state.angle[i] = wheels[i].angle;
    state.speed[i] = wheels[i].speed;
  }
}

// --- UART0 ------------------------------------------------------------------------------------

static void on_sent(avr_irq_t *irq, uint32_t value, void *param) {
  if (state.sent < MOST_BYTES) sent[state.sent++] = (uint8_t)value;
}

static void on_full(avr_irq_t *irq, uint32_t value, void *param) { uart_full = 1; }
static void on_room(avr_irq_t *irq, uint32_t value, void *param) { uart_full = 0; }

static void feed_uart(void) {
  if (waiting_from == waiting_to || uart_full) return;
  avr_raise_irq(uart_in, waiting[waiting_from++ % MOST_BYTES]);
}

static void open_uart(void) {
  uint32_t flags = 0;
  avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  // No copy on standard output, and no sleeping on the host when the sketch polls.
  flags &= ~(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  avr_irq_t *first = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), 0);
  uart_in = first + UART_IRQ_INPUT;
  avr_irq_register_notify(first + UART_IRQ_OUTPUT, on_sent, NULL);
  avr_irq_register_notify(first + UART_IRQ_OUT_XOFF, on_full, NULL);
  avr_irq_register_notify(first + UART_IRQ_OUT_XON, on_room, NULL);
}

// --- time -------------------------------------------------------------------------------------

static void run_until(uint64_t until) {
  static uint64_t next_motor, next_byte;
  while (avr->cycle < until) {
    int how = avr_run(avr);
    if (how == cpu_Done || how == cpu_Crashed) exit(3);
    if (avr->cycle >= next_motor) {
      step_motors();
      next_motor += MOTOR_STEP_US * CYCLES_PER_US;
    }
    if (avr->cycle >= next_byte) {
      feed_uart();
      next_byte = avr->cycle + CYCLES_PER_BYTE;
    }
  }
}

static void never_sleep(avr_t *a, avr_cycle_count_t how_long) {}

static void say_nothing(avr_t *a, const int level, const char *format, va_list words) {}

static void load(const char *file) {
  elf_firmware_t firmware = {0};
  if (elf_read_firmware(file, &firmware)) exit(2);
  avr = avr_make_mcu_by_name("atmega2560");
  if (!avr || avr_init(avr)) exit(2);
  firmware.frequency = HZ;
  avr_load_firmware(avr, &firmware);
  avr->frequency = HZ;
  avr->sleep = never_sleep;
}

static void wire(void) {
  open_uart();
  for (int i = 0; i < 2; i++) {
    struct wheel *w = &wheels[i];
    w->a = avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('D'), w->a_bit);
    w->b = avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('D'), w->b_bit);
    show_tick(w);
  }
}

// --- requests ---------------------------------------------------------------------------------

static int take(void *into, size_t size) { return fread(into, 1, size, stdin) == size; }

static int serve(void) {
  uint32_t request[2];
  static uint64_t until;
  if (!take(request, sizeof request) || request[1] > MOST_BYTES) return 0;
  for (uint32_t i = 0; i < request[1]; i++) {
    if (!take(&waiting[waiting_to % MOST_BYTES], 1)) return 0;
    waiting_to++;
  }
  state.sent = state.changes = 0;
  until += (uint64_t)request[0] * CYCLES_PER_US;
  run_until(until);
  state.time_us = avr->cycle / CYCLES_PER_US;
  fwrite(&state, sizeof state, 1, stdout);
  fwrite(sent, 1, state.sent, stdout);
  fwrite(changes, sizeof changes[0], state.changes, stdout);
  return fflush(stdout) == 0;
}

int main(int count, char **words) {
  if (count != 5) return 2;
  largest_rad_s = atof(words[2]);
  lag_s = atof(words[3]);
  ticks_per_turn = atof(words[4]);
  avr_global_logger_set(say_nothing);  // simavr complains at every analogWrite
  load(words[1]);
  wire();
  while (serve()) {
  }
  return 0;
}
