"""Random wires between walls, made by the hundred, and what every log and summary of them has to say."""
