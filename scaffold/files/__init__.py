"""File system access: files, file trees and the user's cache."""
