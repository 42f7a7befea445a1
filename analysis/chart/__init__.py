"""Error against cost for every method on twelve problems: what is run (`material`, `walls`, `coaxial`), what came of it
(`points`), and how it is shown (`figure`, `tables`, `page`)."""
