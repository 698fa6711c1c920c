"""The language server of keyword decks: `courant lsp`."""
