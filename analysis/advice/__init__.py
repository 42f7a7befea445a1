"""The cheapest settings of a scene that meet an error: what is tried (`trials`), how far off it is and what it costs
(`plan`), and what is told (`report`)."""
