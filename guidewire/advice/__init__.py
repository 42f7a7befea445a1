"""The cheapest settings of a scene that meet an error: the settings tried (`trials`), their error and cost (`plan`),
and the report (`report`)."""
