"""Wrong answers in the warm-up: the mistake that each shows, and the credit left."""

TABLE = {
    "start-kinetic-energy": [
        ("half missing", "I * qd**2", 0),
        ("velocity not squared", "I * qd / 2", 0),
    ],
}
