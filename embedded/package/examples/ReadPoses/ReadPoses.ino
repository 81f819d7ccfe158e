// Receives pose packets from a device over a serial line and prints the poses. Uses the C
// interface, dotpose.h.
#include <dotpose.h>

static dotpose_packet_reader reader;

void setup() {
    Serial.begin(115200);
    dotpose_packet_reader_init(&reader);
}

void loop() {
    if (Serial.available() == 0) return;
    dotpose_packet packet;
    const uint8_t byte = static_cast<uint8_t>(Serial.read());
    if (dotpose_packet_reader_push(&reader, byte, &packet) != DOTPOSE_OK) return;
    Serial.print(dotpose_status_name(packet.status));
    Serial.print(" cell ");
    Serial.print(packet.cell_x);
    Serial.print(" ");
    Serial.print(packet.cell_y);
    Serial.print(" angle ");
    Serial.println(packet.theta_bam16 * (180.0F / 32768));
}
