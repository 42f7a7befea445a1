"""Error against cost for every method on eight problems: what is run (`material`, `walls`), what came of it (`points`),
and how it is shown (`figure`, `tables`, `page`)."""
