// The rover's Arduino Mega: drives two motors, counts two encoders, talks with the host.
//
// Wiring (a motor driver with one PWM and one direction pin a motor, encoders with two channels):
//
//              PWM   direction   encoder A   encoder B
//   left         6          22          18          19
//   right        7          23          20          21
//
// The lines on the cable (115200 baud) are $BODY*CRC, CRC-16/XMODEM of BODY in four digits:
//
//   host   M,SEQ,LEFT,RIGHT               PWM of each motor, -255 to 255
//   board  A,SEQ                          the command SEQ was accepted
//   board  W,SEQ,MS,LEFT,RIGHT            wheel speeds in mrad/s, every 20 ms
//   board  S,MS,ACCEPTED,REJECTED,STOPS   counts, once a second
//
// Without a good command for half a second the motors stop.

#include <util/atomic.h>
#include <util/crc16.h>

struct Wheel {
  uint8_t pwmPin, directionPin, aPin, bPin;
  volatile int32_t ticks;
  int32_t ticksBefore;
};

Wheel left = {6, 22, 18, 19, 0, 0};
Wheel right = {7, 23, 20, 21, 0, 0};

const uint32_t LINE_EVERY_MS = 20, REPORT_EVERY_MS = 1000, STOPS_AFTER_MS = 500;
const float MRAD_PER_TICK = 2000.0 * M_PI / 1440.0;
const uint8_t LONGEST_LINE = 60;

char line[LONGEST_LINE + 1];
uint8_t lineLength = 0;
bool inLine = false;

uint32_t nextLineMs = LINE_EVERY_MS, lastLineMs = 0, nextReportMs = REPORT_EVERY_MS;
uint32_t commandedMs = 0, sequence = 0;
uint32_t accepted = 0, rejected = 0, stops = 0;
int16_t leftPwm = 0, rightPwm = 0;

// --- wheels ---------------------------------------------------------------------------------

// One of the four edges of a quadrature pair: A leads B when the wheel turns forward.
void edgeOfA(Wheel &wheel) {
  wheel.ticks += digitalRead(wheel.aPin) == digitalRead(wheel.bPin) ? -1 : 1;
}

void edgeOfB(Wheel &wheel) {
  wheel.ticks += digitalRead(wheel.aPin) == digitalRead(wheel.bPin) ? 1 : -1;
}

void leftA() { edgeOfA(left); }
void leftB() { edgeOfB(left); }
void rightA() { edgeOfA(right); }
void rightB() { edgeOfB(right); }

void setUpWheel(Wheel &wheel) {
  pinMode(wheel.pwmPin, OUTPUT);
  pinMode(wheel.directionPin, OUTPUT);
  pinMode(wheel.aPin, INPUT_PULLUP);
  pinMode(wheel.bPin, INPUT_PULLUP);
  analogWrite(wheel.pwmPin, 0);
}

void driveWheel(Wheel &wheel, int16_t pwm) {
  digitalWrite(wheel.directionPin, pwm < 0);
  analogWrite(wheel.pwmPin, abs(pwm));
}

void drive(int16_t newLeft, int16_t newRight) {
  if (newLeft != leftPwm) driveWheel(left, newLeft);
  if (newRight != rightPwm) driveWheel(right, newRight);
  leftPwm = newLeft;
  rightPwm = newRight;
}

// Speed since the line before, in mrad/s.
int32_t speedOf(Wheel &wheel, uint32_t ms) {
  int32_t now;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { now = wheel.ticks; }
  int32_t moved = now - wheel.ticksBefore;
  wheel.ticksBefore = now;
  return lround(moved * MRAD_PER_TICK * 1000.0 / ms);
}

// --- lines ----------------------------------------------------------------------------------

uint16_t checksum(const char *body, uint8_t length) {
  uint16_t crc = 0;
  while (length--) crc = _crc_xmodem_update(crc, *body++);
  return crc;
}

void send(const char *body) {
  char end[7];
  snprintf(end, sizeof end, "*%04X\n", checksum(body, strlen(body)));
  Serial.write('$');
  Serial.print(body);
  Serial.print(end);
}

// A whole number of at most five digits; moves `text` behind it and its comma.
bool takeNumber(const char *&text, long smallest, long largest, long &number) {
  bool negative = *text == '-';
  if (negative) text++;
  uint8_t digits = 0;
  for (number = 0; isdigit(*text) && digits < 6; digits++) number = 10 * number + (*text++ - '0');
  if (negative) number = -number;
  if (*text == ',') text++;
  else if (*text) return false;
  return digits && digits < 6 && number >= smallest && number <= largest;
}

bool obey(const char *body) {
  long seq, newLeft, newRight;
  if (strncmp(body, "M,", 2)) return false;
  const char *text = body + 2;
  if (!takeNumber(text, 0, 65535, seq) || !takeNumber(text, -255, 255, newLeft)) return false;
  if (!takeNumber(text, -255, 255, newRight) || *text || text[-1] == ',') return false;
  commandedMs = millis();
  accepted++;
  drive(newLeft, newRight);
  char answer[10];
  snprintf(answer, sizeof answer, "A,%ld", seq);
  send(answer);
  return true;
}

// The line has ended: use it only if its checksum is right.
bool useLine() {
  if (lineLength < 6 || line[lineLength - 5] != '*') return false;
  uint8_t bodyLength = lineLength - 5;
  char expected[5];
  snprintf(expected, sizeof expected, "%04X", checksum(line, bodyLength));
  line[lineLength] = 0;
  if (strcmp(expected, line + bodyLength + 1)) return false;
  line[bodyLength] = 0;
  return obey(line);
}

void hear(char letter) {
  if (letter == '$') {
    rejected += inLine;  // the line before had no end
    inLine = true;
    lineLength = 0;
  } else if (letter == '\n' && inLine) {
    rejected += !useLine();
    inLine = false;
  } else if (inLine && letter != '\r') {
    if (lineLength < LONGEST_LINE) line[lineLength++] = letter;
    else { rejected++; inLine = false; }
  }
}

void tellSpeeds(uint32_t now) {
  uint32_t ms = now - lastLineMs;
  lastLineMs = now;
  char body[48];
  snprintf(body, sizeof body, "W,%lu,%lu,%ld,%ld",
           sequence++, now, speedOf(left, ms), speedOf(right, ms));
  send(body);
}

void tellCounts(uint32_t now) {
  char body[56];
  snprintf(body, sizeof body, "S,%lu,%lu,%lu,%lu", now, accepted, rejected, stops);
  send(body);
}

// --- the program ----------------------------------------------------------------------------

void setup() {
  setUpWheel(left);
  setUpWheel(right);
  attachInterrupt(digitalPinToInterrupt(left.aPin), leftA, CHANGE);
  attachInterrupt(digitalPinToInterrupt(left.bPin), leftB, CHANGE);
  attachInterrupt(digitalPinToInterrupt(right.aPin), rightA, CHANGE);
  attachInterrupt(digitalPinToInterrupt(right.bPin), rightB, CHANGE);
  Serial.begin(115200);
}

void loop() {
  while (Serial.available()) hear(Serial.read());
  uint32_t now = millis();
  if ((leftPwm || rightPwm) && now - commandedMs >= STOPS_AFTER_MS) {
    stops++;
    drive(0, 0);
  }
  if ((int32_t)(now - nextLineMs) >= 0) {
    nextLineMs += LINE_EVERY_MS;
    tellSpeeds(now);
  }
  if ((int32_t)(now - nextReportMs) >= 0) {
    nextReportMs += REPORT_EVERY_MS;
    tellCounts(now);
  }
}
