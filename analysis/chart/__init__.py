"""Error against cost for every method on fourteen problems: the problems (`material`, `walls`, `coaxial`), the results
(`points`), and their presentation (`figure`, `tables`, `page`)."""
