"""The stage: what of the acceleration that gravity does not give it can give, inside its travel."""
