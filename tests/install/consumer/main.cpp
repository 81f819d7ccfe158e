#include <dotpose/status.hpp>

int main() {
    return 0;
}
